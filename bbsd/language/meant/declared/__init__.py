"""Mistakes in what is declared, told there and not at every use: how a value starts, a table, a definition, a base."""
