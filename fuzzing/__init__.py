"""Damaged and heavy specs that `bbsd check` must survive."""
