"""Write the graph of an episode as the Python source of a kernel."""
