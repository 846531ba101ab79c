"""What is meant by specs whose form is wrong: told once, with its correction, and read as meant for all else."""
