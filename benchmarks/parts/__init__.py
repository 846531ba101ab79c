"""The sections of docs/benchmarks.md, a module for each: `section(*, quick)` measures and returns a `Section`."""
