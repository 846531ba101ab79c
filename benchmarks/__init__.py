"""How fast bbsd is, beside what a user would pick instead: `make bench` measures and writes docs/benchmarks.md.

`make bench PART=lifting_rollout` measures one part and prints it; `--quick` takes small sizes and few rounds. Other
programs that do the same work (`peers/`) need JAX and DEAP and have an environment of their own, since numba would
import what they need in every measured process; a missing one is reported as missing.

- `parts/`: one module for each section of the page, with `section(*, quick)`. To add one: write such a module and list
  it in `__main__.py`.
- `peers/`: the other programs. To add one: write a module with `prepare(workload)` and list it in the part that
  measures it.
- `workloads/`: what is computed, as plain arrays that a peer in any language can take.
- `timing.py`, `processes.py`, `report.py`: times of calls, times and memory of processes, and the page.
"""
