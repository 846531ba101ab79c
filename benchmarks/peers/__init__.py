"""What a user would pick instead, each a module with `prepare`: a workload made into a call that lives it."""
