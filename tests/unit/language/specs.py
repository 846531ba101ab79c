"""A small spec, and others that differ from it in a part."""

from bbsd.language.loading import check, load
from bbsd.language.meaning import Meaning
from bbsd.text import Data, Source, read
from bbsd.text.writing.writer import write

BASE = """
bbsd: 1
name: example
environment:
  robots: 3
  steps: 10
  state:
    height: uniform(2, 3)
    speed: 0
  dynamics:
    height: height + speed
  sensors:
    tilt: height - mean(height[r] for r in team)
    tilted: tilt > 1
behaviors:
  stop:
    inputs:
      reached: height >= 3
    actions:
      halt:
        speed: 0
reward:
  near: 1 if abs(height - 3) < 1 else 0
"""


def merged(base: Data, part: Data) -> Data:
    """Lay a part over the base: mappings merge, all else, and empty mappings, replace; null takes away."""
    if not (isinstance(base, dict) and isinstance(part, dict) and part):
        return part
    found = {**base, **{key: merged(base.get(key), value) for key, value in part.items()}}
    return {key: value for key, value in found.items() if value is not None}


def source(part: str = "") -> Source:
    """Return the small spec with a part laid over it."""
    data, laid_over = read(Source("base", BASE)).data, _read(part) if part else {}
    return Source("spec.yaml", write(merged(data, laid_over) if laid_over else data))


def _read(part: str) -> Data:
    document = read(Source("part", part))
    assert not document.diagnoses, document.diagnoses
    return document.data


def meaning_of(part: str = "", seed: int = 0) -> Meaning:
    """Return the meaning of the small spec with a part laid over it; there must be no mistake."""
    return load(source(part), seed=seed).meaning


def codes(part: str) -> list[str]:
    """Return the codes of the mistakes in the small spec with a part laid over it."""
    return [diagnosis.code for diagnosis in check(source(part))]


def messages(part: str) -> list[str]:
    """Return the messages of the mistakes in the small spec with a part laid over it."""
    return [diagnosis.message for diagnosis in check(source(part))]
