"""The syntax of expressions: text to tree, where a text cannot be read, and tree to text."""
