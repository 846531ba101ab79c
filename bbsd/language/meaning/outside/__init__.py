"""An environment that is stepped in Python, in an episode: what is exchanged with it, and mistakes in its use."""
