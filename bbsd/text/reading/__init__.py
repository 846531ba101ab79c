"""From YAML text to a tree of nodes with their offsets, with a diagnosis of everything that is wrong with the text.

`reader` is the entry; `composition` builds the tree of the parser's `events`; `mapping_keys`, `traps` and `syntax` find
the mistakes in keys, in texts that YAML misreads, and in YAML's grammar.
"""
