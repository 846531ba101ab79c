"""The expression language: grammar, words, and the graph of operations that an expression means."""
