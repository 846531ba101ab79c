"""Damaged and heavy specs that `bbsd check` must survive: `make fuzz SECONDS=3600`, or
`python -m fuzzing --seconds 3600 --seed 1`.

- `damage.py` damages specs in their text, data and expressions. To add a kind: write a function of a text and a random
  generator, and list it in `DAMAGES`.
- `heavy_specs.py` makes specs that are large, deep or involved. To add a kind: write a function of a size and a random
  generator, and list it in `KINDS`.
- `folders.py` damages folders of runs and arguments of `--set`; `faults` lets designs fail and be killed.
- `trial.py` checks one spec and finds what rule it broke; `__main__.py` tries specs until the time is over.
"""
