"""Violations of YAML's grammar, explained in terms of what to mend instead of what the parser expected."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from bbsd.errors import Correction, Diagnosis
from bbsd.text.reading.traps import glued

if TYPE_CHECKING:
    from collections.abc import Callable

    from yaml import MarkedYAMLError

    from bbsd.errors import Edit
    from bbsd.text.source import Source

LONGEST_QUOTED = 60
COMMENT = re.compile(r"\s+#.*")
# What precedes a value on its line: dashes of lists and keys.
LEAD = re.compile(r"\s*(?:- +)*(?:[^\s:#'\"][^:#'\"\[{]*:\s+)?")
VALUES_WITH_END = ("[", "{", "'", '"', "*", "&")


class _Trouble(NamedTuple):
    """An error of the parser: `at` is the offset where it was noticed, `since` where the construct begins."""

    source: Source
    context: str
    problem: str
    at: int
    since: int

    @property
    def character(self) -> str:
        return self.source.text[self.at : self.at + 1]

    def before_on_line(self) -> str:
        return self.source.text[self.source.line_start(self.at) : self.at]

    def says(
        self,
        message: str,
        advice: str = "",
        start: int | None = None,
        end: int | None = None,
        edit: Edit | None = None,
    ) -> Diagnosis:
        place = self.source.place(self.at if start is None else start, end)
        return Diagnosis("BB004", message, place, advice, Correction((edit,)) if edit else None)


def explain_syntax_error(source: Source, error: MarkedYAMLError) -> Diagnosis:
    """Return the diagnosis of an error of the parser."""
    trouble = _trouble(source, error)
    if trouble.character == "\t" or "tab character" in trouble.problem:
        return Diagnosis(
            "BB005", "a tab where blanks are expected", source.place(trouble.at), "indent with blanks"
        )
    for context, problem, explanation in _EXPLANATIONS:
        if context in trouble.context and problem in trouble.problem:
            return explanation(trouble)
    return trouble.says(f"this is not YAML: {trouble.problem}")


def _trouble(source: Source, error: MarkedYAMLError) -> _Trouble:
    at = error.problem_mark.index if error.problem_mark else 0
    since = error.context_mark.index if error.context_mark else at
    return _Trouble(source, error.context or "", error.problem or "", min(at, len(source.text)), since)


def _open_quote(trouble: _Trouble) -> Diagnosis:
    return trouble.says("this quote is never closed", start=trouble.since)


def _bad_escape(trouble: _Trouble) -> Diagnosis:
    advice = "between single quotes a backslash is only a backslash"
    return trouble.says(
        "between double quotes this backslash begins an escape that YAML does not know", advice
    )


def _open_bracket(trouble: _Trouble) -> Diagnosis:
    source, bracket = trouble.source, trouble.source.text[trouble.since]
    if trouble.character in {"[", "{"}:
        advice = "put the value in quotes, or write it on its own line under its key"
        return trouble.says(
            f'a value inside {{...}} or [...] cannot contain "{trouble.character}" without quotes', advice
        )
    closing = "}" if bracket == "{" else "]"
    if not trouble.character or _is_outside(source, trouble):
        end = _end_of_text(source, trouble.since)
        edit = source.edit(end, end, closing)
        advice = f'write "{closing}" behind its last value'
        return trouble.says(f'this "{bracket}" is never closed', advice, start=trouble.since, edit=edit)
    return trouble.says(f'there is a comma or a "{closing}" missing before this')


def _is_outside(source: Source, trouble: _Trouble) -> bool:
    """Say whether the line is indented no more than the bracket's, and so was not written to be inside."""
    if source.line_number(trouble.since) == source.line_number(trouble.at):
        return False
    return _indent(source, trouble.at) <= _indent(source, trouble.since)


def _end_of_text(source: Source, offset: int) -> int:
    """Return the offset where the text on an offset's line ends, before blanks and a comment."""
    start = source.line_start(offset)
    return start + len(COMMENT.sub("", source.text[start : source.line_end(offset)]).rstrip())


def _indent(source: Source, offset: int) -> int:
    line = source.line(source.line_number(offset))
    return len(line) - len(line.lstrip(" "))


def _needs_quotes(trouble: _Trouble, start: int | None = None) -> Diagnosis:
    start = _behind_tag(trouble, trouble.since if start is None else start)
    end = trouble.source.line_end(start)
    value = COMMENT.sub("", trouble.source.text[start:end]).rstrip()
    message, edit = (
        f'a value that begins with "{value[:1]}" needs quotes',
        _quoted(trouble.source, start, value),
    )
    return trouble.says(message, _quoting(value), start, start + len(value), edit)


def _behind_tag(trouble: _Trouble, start: int) -> int:
    """Return where the value of a line begins if YAML took its beginning, such as `!(a`, for a tag."""
    line_start = trouble.source.line_start(start)
    lead = LEAD.match(trouble.source.text[line_start:start])
    before = trouble.source.text[line_start + lead.end() : start] if lead else ""
    return line_start + lead.end() if lead and before.startswith("!") else start


def _quoted(source: Source, start: int, value: str) -> Edit | None:
    """Return the edit that puts a value in quotes; None where that needs escapes."""
    return None if '"' in value or "\\" in value else source.edit(start, start + len(value), f'"{value}"')


def _quoting(value: str) -> str:
    if len(value) > LONGEST_QUOTED or '"' in value or "\\" in value:
        return "put all of it in quotes, if an expression is meant"
    return f'write "{value}", if an expression is meant'


def _list_on_key_line(trouble: _Trouble) -> Diagnosis:
    message = "a value cannot begin with a minus and a blank"
    advice = "remove the blank, if a negative number is meant; begin a list on the line below its key"
    return _more_after_value(trouble) or trouble.says(message, advice)


def _more_after_value(trouble: _Trouble) -> Diagnosis | None:
    """Diagnose what follows the closing bracket or quote of a value, or an alias, on the same line."""
    before = trouble.before_on_line()
    lead = LEAD.match(before)
    value = before[lead.end() :] if lead else before
    return _needs_quotes(trouble, trouble.at - len(value)) if value.startswith(VALUES_WITH_END) else None


def _no_key(trouble: _Trouble) -> Diagnosis:
    if trouble.character in {"}", "]"}:
        return _closes_nothing(trouble)
    return _more_after_value(trouble) or _misplaced_line(trouble)


def _misplaced_line(trouble: _Trouble) -> Diagnosis:
    if trouble.source.text.startswith("- ", trouble.at):
        return trouble.says("an item of a list stands among keys", "indent it below the key it belongs to")
    if trouble.source.text[trouble.at : trouble.at + 3] == "...":
        return trouble.says("the document ends here in the middle")
    message = "this line is indented unlike those it should belong to"
    return trouble.says(message, "the keys of one mapping begin in the same column")


def _no_dash(trouble: _Trouble) -> Diagnosis:
    message = "this line stands in a list and does not begin with a dash"
    advice = "indent it as the item above, or move it out of the list"
    return _more_after_value(trouble) or trouble.says(message, advice)


def _second_colon(trouble: _Trouble) -> Diagnosis:
    source, before = trouble.source, trouble.before_on_line()
    lead = LEAD.match(before)
    if lead and lead.end() < len(before) and ":" in lead[0]:
        return _colon_in_value(trouble, source.line_start(trouble.at) + lead.end())
    above = _line_above(source, trouble.at)
    if diagnosis := glued(source, above):
        return diagnosis
    if ":" not in source.text[above : source.line_end(above)]:
        return _no_colon(trouble, above)
    start = trouble.at - len(before.lstrip())
    by = start - source.line_start(start) - (above - source.line_start(above))
    return trouble.says(
        "this line is indented more than the one above it, which has a value already",
        "the keys of one mapping begin in the same column",
        start,
        trouble.at,
        source.edit(start - by, start, "") if by > 0 else None,
    )


def _colon_in_value(trouble: _Trouble, start: int) -> Diagnosis:
    value = COMMENT.sub("", trouble.source.text[start : trouble.source.line_end(start)]).rstrip()
    message = "a value with a colon and a blank in it needs quotes"
    return trouble.says(message, _quoting(value), edit=_quoted(trouble.source, start, value))


def _line_above(source: Source, offset: int) -> int:
    """Return the offset of the text on the last line above an offset's line that is not blank."""
    above = source.text[: source.line_start(offset)].rstrip()
    start = source.line_start(len(above))
    lead = re.compile(r"\s*(?:- +)*").match(source.text, start)
    return lead.end() if lead else start


def _key_without_colon(trouble: _Trouble) -> Diagnosis:
    return glued(trouble.source, trouble.since) or _no_colon(trouble, trouble.since)


def _no_colon(trouble: _Trouble, start: int) -> Diagnosis:
    source, end = trouble.source, trouble.source.line_end(start)
    key = source.text[start : _end_of_text(source, start)]
    if mark := next((mark for mark in ("//", "/*") if key.startswith(mark)), None):
        edit = source.edit(start, start + len(mark), "#")
        return trouble.says(f'a comment begins with #, not with "{mark}"', "", start, end, edit)
    if assigned := ASSIGNED.match(key):
        edit = source.edit(start + assigned.end("key"), start + assigned.end("sign"), ": ")
        message = f'a key is divided from its value by a colon, not by "{assigned["sign"].strip()}"'
        return trouble.says(message, "a line is `key: value` or `- item`", start, end, edit)
    edit = source.edit(start + len(key), start + len(key), ":")
    message = (
        f'there is no colon after "{key}"'
        if len(key) <= LONGEST_QUOTED
        else "there is no colon after this key"
    )
    return trouble.says(message, "a line is `key: value` or `- item`", start, end, edit)


ASSIGNED = re.compile(
    r"(?P<key>[A-Za-z]\w*(?:\([\w, ]*\)|\[[^\]]*\])?)(?P<sign>\s*(?::=|<-|=(?!=))\s*)(?=\S)"
)
"""A key and its value with the sign of an assignment between: `dt = 0.1`, `near(a, b) = a < b`."""


def _closes_nothing(trouble: _Trouble) -> Diagnosis:
    return trouble.says(f'this "{trouble.character}" closes nothing')


def _no_value(trouble: _Trouble) -> Diagnosis:
    if trouble.character in {"}", "]"}:
        return _closes_nothing(trouble)
    if not trouble.character:
        return trouble.says("the file ends inside a {...} or [...] that is never closed")
    return trouble.says("a value is missing before this")


def _directive(trouble: _Trouble) -> Diagnosis:
    return trouble.says(
        "a line cannot begin with %", "a spec needs no such line", trouble.source.line_start(trouble.at)
    )


def _after_end(trouble: _Trouble) -> Diagnosis:
    return trouble.says("there is more after the end of the document", "remove it, or the line with ...")


# (part of the parser's context, part of its problem, the explanation); the first that matches is used.
_EXPLANATIONS: tuple[tuple[str, str, Callable[[_Trouble], Diagnosis]], ...] = (
    ("quoted scalar", "unexpected end of stream", _open_quote),
    ("quoted scalar", "unexpected document indicator", _open_quote),
    ("quoted scalar", "", _bad_escape),
    ("flow", "did not find expected ','", _open_bracket),
    ("directive", "", _directive),
    ("", "incompatible YAML document", _directive),
    ("", "directive", _directive),
    ("scanning a block scalar", "", _needs_quotes),
    ("scanning an alias", "", _needs_quotes),
    ("scanning an anchor", "", _needs_quotes),
    ("tag", "", _needs_quotes),
    ("", "cannot start any token", _needs_quotes),
    ("", "mapping keys are not allowed", _needs_quotes),
    ("", "block sequence entries are not allowed", _list_on_key_line),
    ("", "did not find expected '-'", _no_dash),
    ("", "did not find expected key", _no_key),
    ("", "mapping values are not allowed", _second_colon),
    ("", "could not find expected ':'", _key_without_colon),
    ("", "did not find expected node content", _no_value),
    ("", "expected <document start>", _after_end),
)
