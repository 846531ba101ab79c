"""A run that goes on, as it is watched."""
