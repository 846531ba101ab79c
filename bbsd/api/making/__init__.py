"""What `design` and `price` do: the folder of a design, its runs, and what an interrupt leaves."""
