"""What came of the runs of a command: how they ended, the best so far, what was learned, what was never visited."""
