"""One episode in full: its trace, who decided what, the scene that a view shows, and all that was stored."""
