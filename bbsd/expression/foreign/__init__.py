"""Expressions as other languages and other habits write them: what is foreign in a text, and how it is written here."""
