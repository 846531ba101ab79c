"""Edits of a file that are proven by reading it again: of whole lines, of parts of values, of all uses of a name."""
