import pytest

from bbsd.report.reference.python import documented, fields_text, regenerate, signature_text


def measure(spec: str, *more: int, episodes: int = 1000, fill: str = "random") -> float:
    """Measure something.

    In two paragraphs.

    Args:
        spec: A spec, or
            a | b.
        more: others.
        episodes: How many.
        fill: What with.

    Returns:
        The mean.

    Raises:
        ValueError, OSError: it cannot be read.
    """
    raise OSError(spec, more, episodes, fill)


class Measured:
    """What was measured."""

    mean: float
    """The mean return,
    of all.

    Not shown."""
    _own: int

    @property
    def low(self) -> "int | None":
        """The lowest."""

    def show(self):
        """Show it.

        At length.
        """


def test_a_docstring_is_taken_apart():
    found = documented(measure)
    assert found.text == "Measure something.\n\nIn two paragraphs."
    assert found.arguments == {
        "spec": "A spec, or a | b.", "more": "Others.", "episodes": "How many.", "fill": "What with.",
    }  # fmt: skip
    assert (found.returned, found.errors) == ("The mean.", {"ValueError, OSError": "It cannot be read."})


def test_a_signature_is_as_it_is_written():
    line = 'measure(spec: str, *more: int, episodes: int = 1000, fill: str = "random") -> float'
    assert signature_text("measure", measure) == line
    long = signature_text("measure" * 5, measure)
    assert long.splitlines()[1:3] == ["    spec: str,", "    *more: int,"]


def test_a_result_has_a_row_for_each_public_name():
    rows = fields_text(Measured).splitlines()[4:]
    assert rows == [
        "| `mean` | `float` | The mean return, of all. Not shown. |",
        "| `low` | `'int \\| None'` | The lowest. |",
        "| `show()` |  | Show it. |",
    ]


def test_what_is_between_marks_is_generated_again():
    text = "before\n<!-- generated: tidy -->\nold\n<!-- end -->\nafter\n"
    now = regenerate(text)
    assert now.startswith("before\n<!-- generated: tidy -->\n\n```python\ntidy(spec: AnySpec")
    assert "old" not in now
    assert now.endswith("\n<!-- end -->\nafter\n")
    with pytest.raises(AttributeError):
        regenerate("<!-- generated: untidy -->\n<!-- end -->")
