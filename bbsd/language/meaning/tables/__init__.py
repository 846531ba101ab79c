"""A behavior's table: the names of its cells, and what rules or a text put into them."""
