"""What happens to the graph of a spec before its kernel is written: all passes, in their order."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

from bbsd.compiler.details import Detail
from bbsd.compiler.passes.list_arrays import MOST_ELEMENTS_WRITTEN_OUT, keep_lists_in_arrays
from bbsd.compiler.passes.quick_moduli import compute_moduli_quickly
from bbsd.compiler.passes.robot_loops import MOST_ROBOTS_WRITTEN_OUT, loop_over_robots
from bbsd.compiler.passes.shared_slots import share_slots
from bbsd.compiler.passes.tangents import compare_tangents

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence

    from bbsd.expression.graph import Node
    from bbsd.language.meaning import Meaning


@dataclass(frozen=True, slots=True)
class Program:
    """What a rollout is written from."""

    meaning: Meaning
    to_prove: tuple[Node, ...] = ()
    """Truths of a step without which the rollout's outcome does not count; the detailed rollout replaces it then."""


class Pass(NamedTuple):
    """A rewrite of programs that changes no bit of what an episode comes to."""

    name: str
    rewrite: Callable[[Program], Program]
    details: frozenset[Detail]
    """The rollouts that it is for."""
    why: str


def pipeline(
    most_written_out: int = MOST_ROBOTS_WRITTEN_OUT, most_elements: int = MOST_ELEMENTS_WRITTEN_OUT
) -> tuple[Pass, ...]:
    """Return all passes, first to last.

    A program with more robots than `most_written_out` gets loops over robots, a list of more elements than
    `most_elements` an array.
    """
    return (
        Pass(
            "quick moduli",
            lambda program: replace(program, meaning=compute_moduli_quickly(program.meaning)),
            frozenset({Detail.CREDIT, Detail.TERMS, Detail.PRACTICE, Detail.WORLD}),
            "A remainder by a division is vectorized, and exact where the quotient is certainly small.",
        ),
        Pass(
            "shared slots",
            lambda program: replace(program, meaning=share_slots(program.meaning)),
            frozenset({Detail.CREDIT, Detail.TERMS, Detail.TRACE, Detail.PRACTICE}),
            "What always holds the same value, as three robots' sensors of one tilt do, is computed and stored once.",
        ),
        Pass(
            "robot loops",
            lambda program: replace(program, meaning=loop_over_robots(program.meaning, most_written_out)),
            frozenset({Detail.CREDIT, Detail.TERMS, Detail.PRACTICE}),
            "Compile time does not grow with the number of robots. A trace is not compiled, and names each robot.",
        ),
        Pass(
            "tangents",
            _with_tangents,
            frozenset({Detail.CREDIT}),
            "An arctangent that is only compared need not be computed. Where that is not proven, TERMS computes it; "
            "what is stepped in Python takes so long that no episode may have to run again for it.",
        ),
        Pass(
            "list arrays",
            lambda program: _with_arrays(program, most_elements),
            frozenset({Detail.CREDIT, Detail.TERMS, Detail.PRACTICE}),
            "Neither compile time nor a step grows with a list of which elements are set at an index. A trace is not "
            "compiled, and names each element.",
        ),
    )


def run_passes(
    meaning: Meaning, details: Collection[Detail], passes: Sequence[Pass] | None = None
) -> dict[Detail, Program]:
    """Return the program of each rollout asked for; rollouts share the passes that they begin with."""
    programs = dict.fromkeys(details, Program(meaning))
    for step in pipeline() if passes is None else passes:
        rewritten: dict[int, Program] = {}
        for detail, program in programs.items():
            if detail in step.details:
                if id(program) not in rewritten:
                    rewritten[id(program)] = step.rewrite(program)
                programs[detail] = rewritten[id(program)]
    return programs


def _with_arrays(program: Program, most_elements: int) -> Program:
    episode, to_prove = keep_lists_in_arrays(program.meaning.episode, program.to_prove, most_elements)
    return Program(replace(program.meaning, episode=episode), to_prove)


def _with_tangents(program: Program) -> Program:
    if program.meaning.episode.outside:
        return program
    episode, to_prove = compare_tangents(program.meaning.episode)
    return Program(replace(program.meaning, episode=episode), (*program.to_prove, *to_prove))
