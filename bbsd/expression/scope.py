"""Where an expression stands: what names mean there, which robot it is for, and who hears of its mistakes."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from bbsd.expression.graph import Graph, Node, value_of
from bbsd.expression.mistakes import WHOLE, Mistake, TooManyMistakesError

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping

    from bbsd.expression.tree import Expr, Span

MAX_MISTAKES = 200

Path = tuple[str | int, ...]
"""Where something stands in a spec: keys and positions from the top."""

Value = Node | tuple["Value", ...]
"""A scalar, or a list of values."""


@dataclass(frozen=True, slots=True)
class Shared:
    """A name with one value for all robots: a constant, a value of the world, the step."""

    value: Value


@dataclass(frozen=True, slots=True)
class Deferred:
    """A shared name whose value is made when it is first used."""

    value: Callable[[], Value]


@dataclass(frozen=True, slots=True)
class PerRobot:
    """A name with a value for each robot: state and sensors."""

    value: Callable[[int], Value]


@dataclass(frozen=True, slots=True)
class Definition:
    """A name that stands for an expression, evaluated where it is used."""

    parameters: tuple[str, ...]
    expression: Expr
    path: Path


@dataclass(frozen=True, slots=True)
class Unusable:
    """A name that exists but means nothing here, and why; without a reason it was diagnosed already."""

    code: str = ""
    reason: str = ""
    advice: str = ""


@dataclass(frozen=True, slots=True)
class Unseen:
    """A value of the world, where a behavior would use it: it must be sensed."""


Binding = Shared | Deferred | PerRobot | Definition | Unusable | Unseen


@dataclass(slots=True)
class Findings:
    """What came to light while expressions were elaborated."""

    mistakes: dict[tuple[Path, Mistake], None] = field(default_factory=dict)
    """In the order of finding, each once though most expressions are elaborated for many robots."""
    wholes: list[tuple[Path, Span, str, Node]] = field(default_factory=list)
    """Values that must turn out to be whole numbers, and what for."""
    seen: set[tuple[Path, Span]] = field(default_factory=set)
    """Unknown names that were told of: the next robot's need no search for a near name."""
    entered: tuple[Path, Span] = ((), WHOLE)
    """The expression that was begun last."""
    unseen: list[str] = field(default_factory=list)
    """What a behavior would need to know of the world and of other robots."""

    def report(self, path: Path, code: str, message: str, span: Span = WHOLE, advice: str = "") -> None:
        """Add a mistake; raises TooManyMistakesError when no more are wanted."""
        self.mistakes[path, Mistake(code, message, span, advice)] = None
        if len(self.mistakes) >= MAX_MISTAKES:
            raise TooManyMistakesError

    def is_first(self, place: tuple[Path, Span]) -> bool:
        """Whether an unknown name is met for the first time."""
        first = place not in self.seen
        self.seen.add(place)
        return first

    def has_mistakes_below(self, path: Path) -> bool:
        """Whether there is a mistake at a path or below it."""
        return any(place[: len(path)] == path for place, _ in self.mistakes)


@dataclass(frozen=True, slots=True)
class Draws:
    """Names the draws of one expression: its place, the number of each draw in it, the elements around it."""

    place: str
    ordinals: Mapping[Span, int] = field(default_factory=dict)
    elements: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Scope:
    """Everything that elaborating an expression depends on besides the expression."""

    graph: Graph
    names: Mapping[str, Binding]
    findings: Findings
    robots: int = 1
    robot: int | None = None
    """None where the team is meant."""
    behavior: str = ""
    """The behavior that this is for, if any, which knows only its own robot: what others do must be sensed."""
    path: Path = ()
    local: Mapping[str, Value] = field(default_factory=dict)
    before: Scope | None = None
    """The scope of the decision, for `before(e)`."""
    starting: bool = False
    """At the start of an episode, where `before(e)` is e."""
    draws: Draws | None = None
    """None where nothing may be drawn."""
    static: Callable[[Node], float | None] = lambda _: None
    """The value of a constant node, where it is the same for the whole run."""
    memo: dict[Hashable, Value] = field(default_factory=dict)
    """Values of definitions in this phase."""
    unseen: dict[Hashable, str] = field(default_factory=dict)
    """Of those, what the behavior would need to know that it does not."""

    def at(self, path: Path, robot: int | None = None, *, draws: bool = False) -> Scope:
        """The same names for another expression."""
        place = Draws(".".join(str(part) for part in path)) if draws else None
        return replace(self, path=path, robot=robot, draws=place, local={})

    # The two that are made most often, by hand: `replace` takes three times as long.

    def inside(self, names: Mapping[str, Value], draws: Draws | None) -> Scope:
        """Where these names are known too, as in an element of a generator."""
        return Scope(
            self.graph, self.names, self.findings, self.robots, self.robot, self.behavior, self.path,
            {**self.local, **names}, self.before, self.starting, draws, self.static, self.memo, self.unseen,
        )  # fmt: skip

    def of_robot(self, robot: int) -> Scope:
        """The same place, seen by another robot."""
        return Scope(
            self.graph, self.names, self.findings, self.robots, robot, self.behavior, self.path,
            self.local, self.before, self.starting, self.draws, self.static, self.memo, self.unseen,
        )  # fmt: skip

    def known(self, node: Node) -> float | None:
        """The value of a node, where it is the same for the whole run."""
        return float(value_of(node)) if node.literal else self.static(node)

    def mistake(self, code: str, message: str, span: Span, advice: str = "") -> Node:
        """Tell of a mistake; the value is unknown from then on."""
        self.findings.report(self.path, code, message, span, advice)
        return self.graph.unknown
