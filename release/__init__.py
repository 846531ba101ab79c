"""Checks of what is handed out: the wheel, the source archive, and the environments that they are installed into."""
