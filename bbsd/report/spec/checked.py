"""What `bbsd check` found in specs, as text for people and as plain data for programs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from bbsd.errors import Severity, escape, render_json, render_text
from bbsd.errors.rendering import UNREAD
from bbsd.report.spec.open import open_line, open_list, open_plain
from bbsd.report.spec.size import size_text
from bbsd.report.wording.numbers import count

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bbsd.errors import Diagnosis, SpecError
    from bbsd.language.fixing import Made
    from bbsd.language.meaning import Meaning

WORDS = {Severity.MISTAKE: "mistake", Severity.WARNING: "warning"}


@dataclass(frozen=True, slots=True)
class Checked:
    """A spec's file, its diagnoses, the texts that they refer to, and its meaning; None where it has mistakes."""

    file: str
    diagnoses: tuple[Diagnosis, ...]
    texts: SpecError
    meaning: Meaning | None
    made: tuple[Made, ...] = ()
    """Corrections that were made before."""
    is_written: bool = True
    """Whether the corrections are in the file, and not only shown."""

    def count(self, severity: Severity) -> int:
        """Return how many diagnoses are that severe."""
        return sum(each.severity is severity for each in self.diagnoses)


def checked_text(checked: Checked, *, color: bool, strict: bool, whole: bool = False) -> str:
    """Return the diagnoses of a spec, a verdict, and what is open, in a line or whole.

    Where warnings count as mistakes, a spec with some is not ok.
    """
    texts = checked.texts
    diagnoses = [
        render_text(each, texts.line(each.place), color, texts.corrected_lines(each))
        for each in checked.diagnoses
    ]
    made = [_made_text(checked.file, each, is_written=checked.is_written) for each in checked.made]
    if all(each.code == UNREAD for each in checked.diagnoses) and checked.diagnoses:
        return "\n\n".join(diagnoses)
    return "\n\n".join([*made, *diagnoses, _verdict(checked, strict=strict) + _open(checked, whole=whole)])


def _made_text(file: str, made: Made, *, is_written: bool) -> str:
    """Return what was corrected, with its lines as they were and as they are; what is not written, a diff shows."""
    lines = [("-", line) for line in made.before] + [("+", line) for line in made.after]
    lines = lines if is_written else []
    shown = [f"    {sign} | {escape(line)}" for sign, line in lines if line.strip()]
    place = f"{escape(file)}:{made.diagnosis.place.line}"
    word = "corrected" if is_written else "would be corrected"
    return "\n".join([f"{place}: {word}[{made.diagnosis.code}]: {escape(made.diagnosis.message)}", *shown])


def _open(checked: Checked, *, whole: bool) -> str:
    if checked.meaning is None:
        return ""
    text = open_list(checked.meaning) if whole else open_line(checked.meaning)
    lines = (text if whole else f"open: {text}").splitlines() if text else []
    return "".join(f"\n  {line}" for line in lines)


def _verdict(checked: Checked, *, strict: bool) -> str:
    found = count_text(checked.diagnoses)
    corrected = [f"{len(checked.made)} corrected"] if checked.made else []
    if checked.made and not checked.is_written:
        corrected = [f"{len(checked.made)} would be corrected", "nothing written"]
    if checked.meaning is None:
        return f"{', '.join([found, *corrected])} in {escape(checked.file)}"
    words = [*([] if found and strict else ["ok"]), *([found] if found else []), *corrected]
    return f"{escape(checked.file)}: {', '.join(words)} ({size_text(checked.meaning)})"


def count_text(diagnoses: Iterable[Diagnosis]) -> str:
    """Return how many mistakes and warnings there are: `1 mistake and 2 warnings`; '' where there are none."""
    severities = [each.severity for each in diagnoses]
    numbers = ((severities.count(severity), word) for severity, word in WORDS.items())
    return " and ".join(count(number, word) for number, word in numbers if number)


def checked_plain(specs: Sequence[Checked]) -> dict[str, Any]:
    """Return the diagnoses of all specs, and of each spec how many there are and what is open."""
    return {
        "diagnoses": render_json(each for checked in specs for each in checked.diagnoses),
        "specs": [_plain(checked) for checked in specs],
    }


def _plain(checked: Checked) -> dict[str, Any]:
    return {
        "file": checked.file,
        "mistakes": checked.count(Severity.MISTAKE),
        "warnings": checked.count(Severity.WARNING),
        "corrected": len(checked.made),
        "open": None if checked.meaning is None else open_plain(checked.meaning),
    }
