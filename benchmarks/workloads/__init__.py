"""What the benchmarks compute: shipped and generated specs, random agents, and the same work as plain arrays."""
