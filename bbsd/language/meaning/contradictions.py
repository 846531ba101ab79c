"""Settings of the search that would cancel one another."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import KEY

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.expression.scope import Findings
    from bbsd.language.design import Design


def report_contradictions(design: Design, findings: Findings, *, structure_is_open: bool) -> None:
    """Report a budget beside generations, and settings of learning that have no effect."""
    if (
        design.chosen_method == "paper"
        and design.episodes is not None
        and "generations" in design.coevolution.model_fields_set
    ):
        message = "the generations are given too, and the budget would have no effect"
        advice = "leave out design.coevolution.generations: they follow from the budget"
        findings.report(("design", "budget"), "BB070", message, KEY, advice)
    for key, reason in _without_effect(design, structure_is_open=structure_is_open):
        findings.report(("design", "learning", key), "BB071", f"this has no effect: {reason}", KEY)


def _without_effect(design: Design, *, structure_is_open: bool) -> Iterator[tuple[str, str]]:
    """Yield the settings of learning that have no effect, and why."""
    learning = design.learning
    explores = learning.exploration.text not in ("0", "0.0")
    changed = {
        "exploration": explores,
        "explored": learning.explored != "kept",
        "outside": learning.outside != "keep",
    }
    for key in (key for key, is_changed in changed.items() if is_changed):
        if design.chosen_method != "paper":
            yield key, f"the method {design.chosen_method} does not learn structures in lifetimes"
        elif not structure_is_open:
            yield key, "there is no structure to learn"
        elif key == "explored" and not explores:
            yield key, "there is no exploration"
        elif key == "outside" and learning.estimate == "counters":
            yield key, "only Ṽ of (13) decays, and the estimate is by counters"
        elif key == "exploration" and learning.last >= learning.episodes:
            yield (
                key,
                f"all {learning.episodes} episodes of a lifetime are among the last {learning.last}",
            )


def with_generations(design: Design, *, structure_is_open: bool, evolving: int) -> Design:
    """Return the settings with the generations that follow from a budget, where the paper's loop has one.

    A generation runs the lifetimes of its agents, and where fitness is shared by differences, their last episodes again
    for each behavior that evolves.
    """
    if design.chosen_method != "paper" or design.episodes is None:
        return design
    learning = design.learning
    lifetime = learning.episodes if structure_is_open else learning.last
    if design.sharing == "difference":
        lifetime += min(learning.last, lifetime) * evolving
    generations = max(1, design.episodes // (design.coevolution.agents * lifetime))
    coevolution = design.coevolution.model_copy(update={"generations": generations})
    return design.model_copy(update={"coevolution": coevolution})
