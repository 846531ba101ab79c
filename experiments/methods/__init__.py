"""Methods beside each other at equal budgets, on all shipped tasks: `make methods`, `python -m experiments.methods`.

A cell is a task, a method, a budget and a seed. Its design is that of `bbsd design SPEC --seed SEED --budget BUDGET`
with this method, but a task's drawn constants are those of seed 0 whatever the seed, so that all cells of a task are
about the same task. What a design earns is measured on episodes that all cells of a task have in common, or on all
starts.

- `tasks.py`: the tasks, and what a design earns in them. `contestants.py`: the methods, the paper's loop, and variants
  of `auto` that lack an ingredient. `cells.py`: a cell, its result, and the file that keeps results.
- `trial.py` runs a cell, `carrying.py` many with an engine; `comparison.py` compares results; `tables.py` shows them.

Results are lines of a file; what is there already is not run again, so a comparison may be stopped and extended.
"""
