"""Automatic design of behavior-based agents from a declarative spec.

A spec is a design with holes: what it gives is kept, what it leaves open is designed, and what comes back is the same
spec with the holes filled. The verbs are the command line's: `load`, `check`, `compile`, `design`,
`evaluate`, `explain`.
"""

__version__ = "0.1.0"
