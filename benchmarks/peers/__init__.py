"""What a user would pick instead of bbsd: `prepare(workload)` of each module returns a call that computes it."""
