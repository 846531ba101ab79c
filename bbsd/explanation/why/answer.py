"""The answer to why a robot did what it did: layer by layer, and what would have changed it."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from math import isfinite
from typing import TYPE_CHECKING, Any

from bbsd.architecture import joint_space
from bbsd.architecture.possible import possible_cells
from bbsd.architecture.sayings import one_line
from bbsd.evaluation.tracing.decisions import layers_of
from bbsd.explanation.why.aim import NOBODY
from bbsd.explanation.why.otherwise import otherwise
from bbsd.explanation.why.redesign import deciding

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.architecture import Architecture
    from bbsd.evaluation.tracing.decisions import Layer
    from bbsd.explanation.why.otherwise import Otherwise
    from bbsd.explanation.why.redesign import Deciding
    from bbsd.explanation.why.situation import Listed, Situation
    from bbsd.language.meaning import Meaning


@dataclass(frozen=True, slots=True)
class LayerAnswer:
    """What a layer's behavior perceived and wanted, and what became of it.

    `role` is `controlled`, `suppressed` (excited, with an action, below the one that controlled), `no action`, or
    `not excited`; a behavior that is not excited would have wanted its `wish`.
    """

    layer: int
    """Counted from 1, the lowest."""
    behavior: str
    excited: bool
    condition: str | None
    """When it is excited; None: always."""
    perceived: Mapping[str, str]
    """The cell of each input."""
    wish: str
    role: str


@dataclass(frozen=True, slots=True)
class Answer:
    """Why one robot did what it did in one step."""

    design: str
    robot: int
    robots: int
    episode: int | None
    """None where the situation was described."""
    step: int | None
    behavior: str
    """The behavior that controlled, or nobody."""
    action: str | None
    layers: tuple[LayerAnswer, ...]
    """Highest first."""
    values: Mapping[str, Listed]
    """The robot's state and sensors, and the world, before the step."""
    otherwise: tuple[Otherwise, ...]

    def __repr__(self) -> str:
        who = f"robot {self.robot}: " if self.robots > 1 else ""
        return f"<Answer on {self.design}: {who}{self.action or 'no action'} by {self.behavior}>"

    def to_plain(self) -> dict[str, Any]:
        """Return the answer as plain data for JSON; values that are infinite or not a number are None."""
        values = {name: _plain(value) for name, value in self.values.items()}
        return {**asdict(self), "values": values}


def _plain(value: Listed) -> Any:  # noqa: ANN401 - plain data
    if isinstance(value, tuple):
        return [*map(_plain, value)]
    return None if isinstance(value, float) and not isfinite(value) else value


def answer_of(
    meaning: Meaning,
    architecture: Architecture,
    situation: Situation,
    robot: int,
    *,
    episode: int | None = None,
    step: int | None = None,
    unwanted: Sequence[str] = (),
    wanted: Sequence[str] = (),
) -> Answer:
    """Return why a robot decides as it does in a situation.

    Args:
        meaning: The spec's.
        architecture: What decides.
        situation: What the robot's behaviors perceive.
        robot: Its index.
        episode: The number of the episode that the situation is from, if any.
        step: The step in it.
        unwanted: For each of these names, what would have had to be different for it not to control.
        wanted: For each of these names, what would have had to be different for it to control.

    Raises:
        NoSuchAction: a name stands for nothing.
        AsItWas: an unwanted name did not control, or a wanted one did.
    """
    modules, now = meaning.episode.modules, deciding(architecture, situation)
    space = joint_space(meaning) if unwanted or wanted else None
    possible = possible_cells(meaning, space) if space is not None and space.is_small else None
    asked = [*((name, False) for name in unwanted), *((name, True) for name in wanted)]
    act = now.act
    layers = layers_of(modules, architecture.structure)
    return Answer(
        design=meaning.spec.name,
        robot=robot,
        robots=meaning.spec.environment.robots,
        episode=episode,
        step=step,
        behavior=NOBODY if act.behavior < 0 else modules[act.behavior].name,
        action=None if act.behavior < 0 else [*modules[act.behavior].actions][act.wish - 1],
        layers=tuple(
            _layer(meaning, layer, len(layers) - place, situation, now) for place, layer in enumerate(layers)
        ),
        values=situation.values,
        otherwise=tuple(
            otherwise(modules, architecture, space, situation, name, wanted=is_wanted, possible=possible)
            for name, is_wanted in asked
            if space is not None
        ),
    )


def _layer(meaning: Meaning, layer: Layer, number: int, situation: Situation, now: Deciding) -> LayerAnswer:
    excited = meaning.spec.behaviors[layer.behavior].excited
    return LayerAnswer(
        layer=number,
        behavior=layer.behavior,
        excited=situation.excited[layer.index],
        condition=None if excited is None else one_line(excited),
        perceived=layer.cell_labels(situation.cells[layer.index]),
        wish=layer.wish(now.wishes[layer.index]),
        role=_role(layer.index, now),
    )


def _role(behavior: int, now: Deciding) -> str:
    if not now.excited[behavior]:
        return "not excited"
    if not now.wishes[behavior]:
        return "no action"
    return "controlled" if now.act.behavior == behavior else "suppressed"
