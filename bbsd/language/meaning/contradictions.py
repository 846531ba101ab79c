"""Settings of the search that would cancel one another."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import KEY

if TYPE_CHECKING:
    from bbsd.expression.scope import Findings
    from bbsd.language.design import Design


def report_contradictions(design: Design, findings: Findings, *, structure_is_open: bool) -> None:
    """Report a budget beside generations, and exploration that has no effect."""
    if (
        design.chosen_method == "paper"
        and design.episodes is not None
        and "generations" in design.coevolution.model_fields_set
    ):
        message = "the generations are given too, and the budget would have no effect"
        advice = "leave out design.coevolution.generations: they follow from the budget"
        findings.report(("design", "budget"), "BB070", message, KEY, advice)
    if design.learning.exploration.text not in ("0", "0.0") and (
        reason := _why_no_exploration(design, structure_is_open=structure_is_open)
    ):
        findings.report(("design", "learning", "exploration"), "BB071", f"this has no effect: {reason}", KEY)


def _why_no_exploration(design: Design, *, structure_is_open: bool) -> str:
    """Return why exploration has no effect, or ""."""
    if design.chosen_method != "paper":
        return f"the method {design.chosen_method} does not learn structures in lifetimes"
    if not structure_is_open:
        return "there is no structure to learn"
    if design.learning.last >= design.learning.episodes:
        return (
            f"all {design.learning.episodes} episodes of a lifetime are among the last {design.learning.last}"
        )
    return ""


def with_generations(design: Design, *, structure_is_open: bool) -> Design:
    """Return the settings with the generations that follow from a budget, where the paper's loop has one."""
    if design.chosen_method != "paper" or design.episodes is None:
        return design
    lifetime = design.learning.episodes if structure_is_open else design.learning.last
    generations = max(1, design.episodes // (design.coevolution.agents * lifetime))
    coevolution = design.coevolution.model_copy(update={"generations": generations})
    return design.model_copy(update={"coevolution": coevolution})
