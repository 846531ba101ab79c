"""Read YAML into nodes that know their place, and report everything that is wrong with it."""
