"""A spec: what may be written, how it is read, what it means, and what can be wrong with it."""
