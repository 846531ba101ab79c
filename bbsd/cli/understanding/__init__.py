"""The commands that say why a design does what it does."""
