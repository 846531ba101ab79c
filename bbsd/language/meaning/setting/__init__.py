"""What the actions of behaviors set: state as a whole, and elements of lists."""
