"""The version, apart from everything else, so that any layer may name it."""

__version__ = "0.1.0"

REVISION = 4
"""The number of what runs compute and keep, part of a run's identity and of its checkpoint.

It goes up by one with every change after which the same spec and seed give other bytes of `architecture.yaml` or
`metrics.jsonl`, or after which a checkpoint means something else: no folder is resumed by code of another revision.
`python -m tests.runs` then makes the folders that every later version must read.
"""
