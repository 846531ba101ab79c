"""Settings of the search that would cancel one another."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import KEY

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.expression.scope import Findings
    from bbsd.language.base import Part
    from bbsd.language.design import Design


def report_contradictions(design: Design, findings: Findings, *, structure_is_open: bool) -> None:
    """Report settings of which one leaves another nothing to do, each at the key that is written."""
    if (
        design.chosen_method == "paper"
        and design.episodes is not None
        and "generations" in design.coevolution.model_fields_set
    ):
        message = "the generations are given too, and the budget would have no effect"
        advice = "leave out design.coevolution.generations: they follow from the budget"
        findings.report(("design", "budget"), "BB070", message, KEY, advice)
    if design.chosen_method == "paper":
        for path, message, advice in _contradictions(design, structure_is_open=structure_is_open):
            findings.report(("design", *path), "BB126", message, KEY, advice)
    episodes = _episodes(design, structure_is_open=structure_is_open)
    wait = design.stop.unimproved
    if wait is not None and episodes is not None and wait >= episodes:
        message = (
            f"a run has {episodes:,} episodes, so that it ends before {wait:,} pass without anything better"
        )
        findings.report(
            ("design", "stop", "unimproved"), "BB171", message, KEY, "let it be less, or leave it out"
        )
    for key, reason in _without_effect(design, structure_is_open=structure_is_open):
        findings.report(("design", "learning", key), "BB071", f"this has no effect: {reason}", KEY)


def _episodes(design: Design, *, structure_is_open: bool) -> int | None:
    """Return the episodes of a run, None where they are not known before it begins."""
    if design.episodes is not None or design.chosen_method != "paper":
        return design.episodes
    if design.sharing == "difference":
        return None
    lifetime = design.learning.episodes if structure_is_open else design.learning.last
    return design.coevolution.generations * design.coevolution.agents * lifetime


def _contradictions(design: Design, *, structure_is_open: bool) -> Iterator[tuple[tuple[str, ...], str, str]]:
    """Yield the settings of the paper's loop that leave another one nothing to do: the key, why, and what to write."""
    evolved, learning = design.coevolution, design.learning
    population, agents = evolved.population, evolved.agents
    if evolved.elites >= population:
        message = f"all individuals of a pool, {population}, would be elites, so that nothing is bred"
        yield (
            _written(evolved, "coevolution", "elites", "population"),
            message,
            f"let elites be at most {population - 1}" if population > 1 else "let population be 2 or more",
        )
    if agents < population:
        message = f"{agents} agents cannot try {population} individuals: each agent has one from each pool"
        advice = f"let agents be {population} or more, a multiple of the population at best"
        yield _written(evolved, "coevolution", "agents", "population"), message, advice
    if structure_is_open and learning.last > learning.episodes:
        message = f"a lifetime of {learning.episodes} episodes does not have {learning.last} last ones"
        advice = f"let last be {learning.episodes} or less"
        yield _written(learning, "learning", "last", "episodes"), message, advice
    generations = range(1, evolved.generations + 1)
    if design.record != "none" and design.episodes is None and not any(map(design.records, generations)):
        message = f"nothing would be recorded in {evolved.generations} generations"
        yield ("record",), message, f"generations count from 1 to {evolved.generations}"


def _written(block: Part, name: str, key: str, other: str) -> tuple[str, ...]:
    """Return the path of the first of two keys that the spec has."""
    is_written = key in block.model_fields_set or other not in block.model_fields_set
    return (name, key if is_written else other)


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
