"""What is certain of a spec without running it: cells that cover everything, values that stay whole."""
