"""Lists as other languages have them: in brackets where an expression stands, with elements counted from 1."""
