"""What an agent perceived in a step, as a situation that can be explained."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.architecture.needs import BEFORE
from bbsd.architecture.policy import joint_space
from bbsd.explanation.why.situation import Situation, values_of_robot

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.agent.program import Program, Scalar
    from bbsd.language.meaning import Meaning


def situation_of(
    meaning: Meaning, program: Program, cells: Sequence[Scalar], values: Sequence[Scalar]
) -> Situation:
    """Return the situation of an agent's robot.

    Args:
        meaning: The spec's.
        program: The agent's.
        cells: The index of the present cell of each dimension that decisions depend on, in order.
        values: The values of the inputs, then what was kept before the step.
    """
    space = joint_space(meaning)
    joint = dict(zip(program.needs.cells, map(int, cells), strict=True))
    excited, own = list[bool](), list[int]()
    for projection in space.projections:
        axis = projection.excitement
        excited.append(
            projection.excited_at == 1 if axis is None else joint.get(axis, -1) == projection.excited_at
        )
        place = 0
        for each, size in zip(projection.axes, projection.sizes, strict=True):
            place = place * size + joint.get(each, 0)
        own.append(place)
    labels = {slot: each.cells for each in program.inputs.values() if each.cells for slot in each.slots}
    shown = {
        slot: labels[slot][int(value)] if slot in labels else value
        for slot, value in zip(program.values, values, strict=True)
        if not slot.name.startswith(BEFORE)
    }
    return Situation(tuple(excited), tuple(own), values_of_robot(shown, program.robot))
