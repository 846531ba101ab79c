"""What is said of a spec and its environment before an episode is run: mistakes, what is left open, sizes, prices."""
