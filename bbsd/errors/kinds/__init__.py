"""The kinds of mistakes and warnings, a module for each place in which they are found."""
