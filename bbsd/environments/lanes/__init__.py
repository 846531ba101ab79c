"""Environments in the lanes of a kernel."""
