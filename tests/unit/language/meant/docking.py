"""A spec of which one part is written in another form, and the whole as it is corrected."""

from __future__ import annotations

from bbsd.language.loading import check
from bbsd.text import Source

SPEC = """\
bbsd: 1
name: docking
constants:
  dt: 0.1
environment:
  robots: 2
  steps: 100
  state:
    distance: uniform(2, 5)
    speed: 0
    seen: list(false for k in range(4))
    mode: one of [near, away]
  dynamics:
    distance: max(distance - speed * dt, 0)
  sensors:
    zone: cut(distance, 0.2, 1)
    contact: distance == 0
behaviors:
  drive:
    inputs: [contact]
    actions:
      halt:
        speed: 0
      mark:
        seen[0]: true
    rules:
      - when: {contact: true}
        do: halt
      - otherwise: no action
structure: [drive]
reward:
  docked: 1 if distance == 0 else 0
"""


def made(old: str, new: str) -> Source:
    assert SPEC.count(old) == 1
    return Source("docking.yaml", SPEC.replace(old, new))


def corrected(source: Source) -> str:
    """Return a spec with its only mistake corrected, certain or not."""
    (mistake,) = check(source)
    assert mistake.correction is not None, mistake
    return source.edited(mistake.correction.edits).text
