"""What the names of a spec stand for: constants, definitions, names of values, slots, and their order."""
