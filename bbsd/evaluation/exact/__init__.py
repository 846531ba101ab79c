"""What is known exactly: every start run once, and chains of states by whose distributions nothing is sampled."""
