"""All runs of a command: done here or by workers, in portions, and what comes back is kept."""
