"""The formatters that IPython calls for results. Types are named, so that none is imported before there is a value."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bbsd.report.notebook.html import html_of, preformatted, table_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.api import Designed
    from bbsd.evaluation import Evaluation, Trace
    from bbsd.explanation import Explanation
    from bbsd.explanation.comparison import Comparison
    from bbsd.explanation.faults import Degradations
    from bbsd.explanation.why import Answer
    from bbsd.explanation.worth import Worth
    from bbsd.runs.storage.watching import Watched

SHOWN = 5
"""Steps of a trace that are shown at its beginning, and at its end."""


def register(shell: Any) -> None:  # noqa: ANN401 - IPython is optional
    """Let an IPython shell show results as tables; what it showed before is replaced."""
    formatter = shell.display_formatter.formatters["text/html"]
    for place, show in FORMATTERS.items():
        module, _, name = place.rpartition(".")
        formatter.for_type_by_name(module, name, show)


def _evaluation(evaluation: Evaluation) -> str:
    from bbsd.report.tables import evaluation_table

    return html_of(evaluation_table(evaluation))


def _designed(designed: Designed) -> str:
    from bbsd.report.tables import design_table

    return html_of(design_table(designed))


def _comparison(comparison: Comparison) -> str:
    from bbsd.report.comparison import comparison_table

    return html_of(comparison_table(comparison))


def _worth(worth: Worth) -> str:
    from bbsd.report.worth import worth_table

    return html_of(worth_table(worth))


def _faults(found: Degradations) -> str:
    from bbsd.report.faults import faults_table

    return html_of(faults_table(found))


def _explanation(explanation: Explanation) -> str:
    from bbsd.explanation import explanation_text

    return preformatted(explanation_text(explanation))


def _answer(answer: Answer) -> str:
    from bbsd.explanation.why import answer_text

    return preformatted(answer_text(answer))


def _watched(watched: Watched) -> str:
    from bbsd.report.watching.words import watched_view

    return html_of(watched_view(watched))


def _trace(trace: Trace) -> str:
    """Return the first and the last steps of a trace; `to_frame` has all of them."""
    from bbsd.evaluation.tracing.traced import trace_columns

    columns = list(trace_columns(trace))
    rows = [
        (step, *values) for step, values in enumerate(zip(*(values for _, values in columns), strict=True))
    ]
    headings = ["step", *(slot.label(trace.robots) for slot, _ in columns)]
    if len(rows) > 2 * SHOWN:
        gap = tuple("⋮" for _ in headings)
        rows = [*rows[:SHOWN], gap, *rows[-SHOWN:]]
    return html_of(repr(trace)) + table_of(headings, rows)


FORMATTERS: dict[str, Callable[[Any], str]] = {
    "bbsd.evaluation.statistics.Evaluation": _evaluation,
    "bbsd.evaluation.tracing.traced.Trace": _trace,
    "bbsd.api.results.Designed": _designed,
    "bbsd.explanation.words.Explanation": _explanation,
    "bbsd.explanation.why.answer.Answer": _answer,
    "bbsd.explanation.comparison.results.Comparison": _comparison,
    "bbsd.explanation.worth.results.Worth": _worth,
    "bbsd.explanation.faults.Degradations": _faults,
    "bbsd.runs.storage.watching.Watched": _watched,
}
"""By the module and name of a type, what makes HTML of its values."""
