"""Environments of other people, stepped in Python."""
