"""Expressions that can be read and have no meaning, and what is probably meant by them."""
