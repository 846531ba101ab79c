"""From a design to the programs of its robots."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from bbsd.agent.inputs import BadInput, inputs_of
from bbsd.agent.program import Program
from bbsd.agent.writing import slots_read
from bbsd.architecture.controller import controller_of
from bbsd.architecture.needs import needs_of
from bbsd.architecture.needs.naming import BEFORE
from bbsd.expression.graph import evaluate
from bbsd.expression.kinds import Kind
from bbsd.expression.nesting import lengths_of
from bbsd.language.meaning.proofs.whole_numbers import whole_values

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from bbsd.agent.program import Kept
    from bbsd.architecture import Architecture
    from bbsd.architecture.controller import Controller
    from bbsd.architecture.needs import Needs, RobotNeeds
    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning


@dataclass(frozen=True, slots=True)
class Design:
    """A design, what its robots need, which slots hold whole numbers, and the constants as they are at the end."""

    meaning: Meaning
    architecture: Architecture
    controller: Controller
    needs: Needs
    whole: frozenset[Slot]
    constants: Sequence[float]

    @property
    def n_robots(self) -> int:
        """The number of robots of the team."""
        return len(self.needs.robots)


def design_of(
    meaning: Meaning,
    architecture: Architecture,
    measured: Collection[str] = (),
    remembered: Collection[str] = (),
) -> Design:
    """Return what agents of a design are made from.

    Raises:
        NotMeasured, NotRemembered: a name is of nothing that can be measured or remembered.
    """
    controller = controller_of(meaning, architecture)
    needs = needs_of(meaning, controller, raw=False, measured=measured, remembered=remembered)
    whole = frozenset(whole_values(meaning.episode, meaning.constants))
    constants = meaning.constants.vector(meaning.spec.design.coevolution.generations)
    return Design(meaning, architecture, controller, needs, whole, constants)


def program_of(design: Design, robot: int) -> Program:
    """Return the program of one of the robots, counted from 0. Raises BadInput where there is none of that number."""
    if not 0 <= robot < design.n_robots:
        raise BadInput(f"there is no robot {robot}: the design is for {design.n_robots}, counted from 0")
    needs = design.needs.robots[robot]
    read, kept = slots_read(needs)
    inputs = inputs_of(design.meaning, design.needs.given, read, design.whole, robot)
    start = _start(needs, kept, design.constants)
    return Program(
        design.controller,
        robot,
        needs,
        inputs,
        tuple(kept),
        start,
        design.constants,
        named=design.meaning.episode.named,
        lengths=_lengths(design.meaning),
    )


def _lengths(meaning: Meaning) -> dict[str, tuple[int, ...]]:
    """Return the lengths of each value's lists, and of what it was before."""
    lengths = lengths_of(slot.variable for slot in meaning.episode.start)
    return lengths | {f"{BEFORE}{name}": each for name, each in lengths.items()}


def _start(needs: RobotNeeds, kept: Sequence[Slot], constants: Sequence[float]) -> Kept:
    """Return what is kept before the first step; nothing reads what was before then."""

    def leaf(node: Node, operands: list[Any]) -> Any:  # noqa: ANN401 - a number, a truth or a cell index
        return node.read(constants, operands)

    starts = dict(zip(needs.start, evaluate(needs.start.values(), leaf), strict=True))
    blank = {Kind.TRUTH: False, Kind.CELL: 0}
    return tuple(starts[slot] if slot in starts else blank.get(needs.next[slot].kind, 0.0) for slot in kept)
