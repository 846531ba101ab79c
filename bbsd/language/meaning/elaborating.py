"""From a spec to its meaning, or to all the mistakes in it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import Graph, GraphTooLargeError
from bbsd.expression.scope import Findings, Path, Shared, Unusable
from bbsd.expression.syntax.mistakes import Mistake, TooManyMistakesError
from bbsd.language.meaning.contradictions import report_contradictions, with_generations
from bbsd.language.meaning.episode.elaborating import elaborate_episode
from bbsd.language.meaning.meaning import Meaning, seed_key
from bbsd.language.meaning.naming.choices import report_names_of_values
from bbsd.language.meaning.naming.constants import read_constants
from bbsd.language.meaning.naming.definitions import (
    read_definitions,
    report_duplicates,
    report_unordered,
    shared_namespace,
)
from bbsd.language.meaning.naming.names import Names
from bbsd.language.meaning.outside.checking import report_outside
from bbsd.language.meaning.proofs.whole_numbers import report_fractions
from bbsd.language.meaning.rates import evaluate_rates
from bbsd.language.meaning.structure import elaborate_structure

if TYPE_CHECKING:
    from bbsd.language.models import Spec


def elaborate(
    spec: Spec, seed: int, broken: frozenset[str] = frozenset()
) -> tuple[Meaning | None, tuple[tuple[Path, Mistake], ...]]:
    """Return a spec's meaning, or None where it has mistakes; and all mistakes and then warnings with their paths.

    `broken` are names whose own mistakes were reported before; no mistake in their use is reported.
    """
    findings = Findings()
    try:
        meaning = _elaborate(spec, seed, broken, findings)
    except TooManyMistakesError:
        meaning = None
    except GraphTooLargeError:
        meaning, (path, span) = None, findings.entered
        advice = "use fewer robots, or shorter lists and ranges"
        findings.mistakes[
            path, Mistake("BB068", "the spec unrolls to too many values here", span, advice)
        ] = None
    found = (*findings.mistakes, *findings.warnings)
    return None if findings.mistakes or broken else meaning, found


def _elaborate(spec: Spec, seed: int, broken: frozenset[str], findings: Findings) -> Meaning | None:
    if not report_outside(spec, findings):
        return None
    graph = Graph()
    definitions = read_definitions(spec.environment.definitions, findings)
    unusable = {name: Unusable() for name in broken}
    namespace = shared_namespace(spec, definitions)
    unusable |= report_duplicates(namespace, findings)
    report_names_of_values(spec.environment, namespace, findings)
    unusable |= report_unordered(spec, definitions, findings, unusable)
    constants = read_constants(spec.constants, seed_key(seed), graph, findings, frozenset(unusable))
    episode = elaborate_episode(Names(spec, graph, findings, constants, definitions, unusable))
    structure = elaborate_structure(spec, findings, broken)
    report_contradictions(spec.design, findings, structure_is_open=structure.is_open)
    modules = () if episode is None else episode.modules
    evolving = sum(module.table.is_open and structure.may_hold(index) for index, module in enumerate(modules))
    design = with_generations(spec.design, structure_is_open=structure.is_open, evolving=evolving)
    spec = spec.model_copy(update={"design": design}) if design is not spec.design else spec
    shared = {name: Shared(value) for name, value in constants.values.items()} | unusable
    rates = evaluate_rates(spec, graph, findings, shared)
    report_fractions(episode, constants, findings)
    if episode is None:
        return None
    equalities = tuple(dict.fromkeys(findings.equalities))
    return Meaning(spec, seed, graph, constants, episode, structure, rates, equalities)
