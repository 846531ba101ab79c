"""Damaged specs, for as long as wanted: `python benchmarks/fuzz.py --seconds 3600`.

Every shipped and every test spec is damaged at random, character by character, line by line and word by word.
Nothing but diagnoses may come out: no traceback, and no check that takes more than two seconds of the processor.
Exits with 1 and keeps the spec that broke the rule.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import tempfile
import time
import traceback
from pathlib import Path

from bbsd.errors import SpecError, render_text
from bbsd.expression.vocabulary import RESERVED
from bbsd.spec.loading import check
from bbsd.text import Source

ROOT = Path(__file__).parents[1]
SLOW = 2.0
SIGNS = [
    "1e308",
    "0",
    "-1",
    "NaN",
    ".inf",
    "null",
    "[",
    "{",
    "}",
    "]",
    "-",
    "&a",
    "*a",
    "<<",
    "!!x",
    "|",
    ">",
    "#",
    "'",
    '"',
    "é",
    "x-",
]
WORDS = [*sorted(RESERVED), *SIGNS, ": ", "\t", "(" * 30, "9" * 400]


def damaged(text: str, dice: random.Random) -> str:
    """The text with one to six things done to it."""
    for _ in range(dice.randint(1, 6)):
        text = dice.choice((_character, _line, _word, _splice))(text, dice)
    return text


def _character(text: str, dice: random.Random) -> str:
    place = dice.randrange(len(text) + 1)
    return (
        text[:place]
        + chr(dice.choice((dice.randrange(32, 127), dice.randrange(1, 0x2FFF))))
        + text[place + dice.randint(0, 2) :]
    )


def _line(text: str, dice: random.Random) -> str:
    lines = text.split("\n")
    place, other = dice.randrange(len(lines)), dice.randrange(len(lines))
    lines[place] = dice.choice(
        ("", lines[other], "  " * dice.randint(0, 5) + lines[place].strip(), lines[place] * 2)
    )
    return "\n".join(lines)


def _word(text: str, dice: random.Random) -> str:
    words = re.split(r"(\W)", text)
    words[dice.randrange(len(words))] = dice.choice((*WORDS, *words))
    return "".join(words)


def _splice(text: str, dice: random.Random) -> str:
    first, last = sorted((dice.randrange(len(text) + 1), dice.randrange(len(text) + 1)))
    part = text[first : min(last, first + 200)]
    place = dice.randrange(len(text) + 1)
    return text[:place] + part + text[place:]


def broken_by(text: str) -> str:
    """What is wrong with how the check took this text; nothing if it did as it should."""
    source, began = Source("fuzzed.yaml", text), time.process_time()
    try:
        for diagnosis in check(source):
            render_text(diagnosis, source.line(diagnosis.place.line))
    except SpecError:
        return "a mistake was raised instead of told"
    except Exception:  # noqa: BLE001 - whatever it is, it is what is looked for
        return traceback.format_exc()
    taken = time.process_time() - began
    return f"the check took {taken:.1f} s" if taken > SLOW else ""


def main() -> int:
    """Damage specs until the time is over or one of them breaks a rule."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    dice = random.Random(options.seed)
    specs = [
        path.read_text() for path in sorted((*ROOT.glob("specs/*.yaml"), *ROOT.glob("tests/specs/*/*.yaml")))
    ]
    end, tried = time.monotonic() + options.seconds, 0
    while time.monotonic() < end:
        text = damaged(dice.choice(specs), dice)
        tried += 1
        if wrong := broken_by(text):
            kept = Path(tempfile.mkdtemp()) / "fuzzed.yaml"
            kept.write_text(text, encoding="utf-8", errors="surrogatepass")
            print(f"after {tried} specs: {kept}\n{wrong}")
            return 1
    print(
        f"{tried} damaged specs in {options.seconds:.0f} s: nothing but diagnoses, none took longer than {SLOW:.0f} s"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
