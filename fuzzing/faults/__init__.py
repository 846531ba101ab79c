"""Faults in whole designs, each followed by what a user would do: `python -m fuzzing.faults`, `make faults`.

After every fault a design must come to the bytes of one that nothing disturbed, or refuse and say how to go on.

- `commands.py` runs commands of bbsd in processes of their own, forked from one that has loaded everything, kernels
  too; `worker.py` is a process that does runs for them.
- `system.py` counts the calls that change files, and lets one of them fail or end the process.
- `calls.py` lets every call of a design fail or end it, one after another; `kills.py` ends it at random instants.
- `states.py` damages and forges checkpoints; `races.py` lets two commands write in one folder.
"""

from __future__ import annotations

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # a process that forks others must have one thread
