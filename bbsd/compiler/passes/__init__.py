"""Rewrite the graph of an episode before a kernel is written: graph in, graph out."""
