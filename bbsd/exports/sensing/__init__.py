"""Designs in C with all that they compute: sensors, cells, excitation, assignments and memory, in binary64."""
