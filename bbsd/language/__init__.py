"""The language of specs: its models, and how a spec is read, checked and given its meaning."""
