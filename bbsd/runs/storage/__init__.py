"""What is kept of runs on disk: folders, records, checkpoints, the lock, and whose a run is."""
