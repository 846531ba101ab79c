"""Write YAML: new text, one changed block of an existing text, or a whole text in the house style."""
