"""Carry out runs of the method: processes, a run's folder and checkpoints, prices, interrupts."""
