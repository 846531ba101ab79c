"""The scope of an expression: what names mean in it, which robot it is for, and where mistakes are collected."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.graph import Graph, Node, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.syntax.mistakes import WHOLE, Mistake, TooManyMistakesError

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping

    from bbsd.expression.syntax.mistakes import Addition, Enclosing, Rewriting
    from bbsd.expression.syntax.tree import Expr, Span

MAX_MISTAKES = 200

Path = tuple[str | int, ...]
"""The place of something in a spec: keys and positions from the top."""

Names = tuple[str, ...]
"""The names that a state can be one of, in order; the number of a value is its name's place."""


@dataclass(frozen=True, slots=True)
class Named:
    """A value that is one of several names, as a number for each list of names that it may be of.

    A bare name is of every state's list that has it, until something tells which is meant; all else is of one.
    """

    readings: tuple[tuple[Names, Node], ...]

    @property
    def kind(self) -> Kind:
        """The kind of the value."""
        return Kind.NAMED

    def of(self, names: Names) -> Node | None:
        """Return the number of the value among these names; None where it is none of them."""
        return next((node for own, node in self.readings if own == names), None)

    @property
    def names(self) -> Names:
        """The names of which the value is one; of the first list where several could be meant."""
        return self.readings[0][0]

    @property
    def node(self) -> Node:
        """The number of the value among those names."""
        return self.readings[0][1]

    @property
    def is_settled(self) -> bool:
        """Whether it is known of which list the value is."""
        return len(self.readings) == 1

    def with_nodes(self, new: Callable[[Node], Node]) -> Named:
        """Return the same value with other numbers."""
        return Named(tuple((names, new(node)) for names, node in self.readings))


Value = Node | Named | tuple["Value", ...]
"""A scalar, or a list of values."""

Plain = Node | tuple["Plain", ...]
"""A number or a truth, or a list of them."""


class Shared(NamedTuple):
    """A name with one value for all robots: a constant, a value of the world, the step."""

    value: Value


class Deferred(NamedTuple):
    """A shared name whose value is elaborated when it is first used."""

    value: Callable[[], Value]


class PerRobot(NamedTuple):
    """A name with a value for each robot: state and sensors."""

    value: Callable[[int], Value]


class Definition(NamedTuple):
    """A name that stands for an expression, evaluated where it is used."""

    parameters: tuple[str, ...]
    expression: Expr
    path: Path


@dataclass(frozen=True, slots=True)
class Unusable:
    """A name that exists but cannot be used here, and why; without a reason its mistake was reported before."""

    code: str = ""
    reason: str = ""
    advice: str = ""
    cells: Mapping[str, str] = field(default_factory=dict)
    """Of a partition: what holds in each of its cells, as an expression."""


@dataclass(frozen=True, slots=True)
class Unseen:
    """A value of the world, where a behavior would use it: it can only sense it."""


Binding = Shared | Deferred | PerRobot | Definition | Unusable | Unseen


@dataclass(slots=True)
class Findings:
    """Mistakes and open questions of expressions, collected while they are elaborated."""

    mistakes: dict[tuple[Path, Mistake], None] = field(default_factory=dict)
    """In order of discovery, each once though most expressions are elaborated for many robots."""
    wholes: list[tuple[Path, Span, str, Node]] = field(default_factory=list)
    """Values that must be proven to be whole numbers, each with its place and purpose."""
    equalities: list[tuple[Path, Span, Node, Node]] = field(default_factory=list)
    """Numbers that are compared by == or !=, each pair with its place."""
    seen: set[tuple[Path, Span]] = field(default_factory=set)
    """Unknown names that were reported: for the next robot no near name has to be searched."""
    entered: tuple[Path, Span] = ((), WHOLE)
    """The expression that was started last."""
    warnings: dict[tuple[Path, Mistake], None] = field(default_factory=dict)
    """What can be used, but probably does not say what was meant; as `mistakes`."""
    unseen: list[str] = field(default_factory=list)
    """Values of the world and of other robots that a behavior uses and cannot know."""

    def report(
        self,
        path: Path,
        code: str,
        message: str,
        span: Span = WHOLE,
        advice: str = "",
        correction: Rewriting | Enclosing | Addition | None = None,
    ) -> None:
        """Add a mistake. Raises TooManyMistakesError with the last of `MAX_MISTAKES`."""
        self.add(path, Mistake(code, message, span, advice, correction))

    def add(self, path: Path, mistake: Mistake) -> None:
        """Add a mistake as it is; as `report`."""
        self.mistakes[path, mistake] = None
        if len(self.mistakes) >= MAX_MISTAKES:
            raise TooManyMistakesError

    def warn(self, path: Path, code: str, message: str, span: Span = WHOLE, advice: str = "") -> None:
        """Add a warning, unless there are `MAX_MISTAKES` already."""
        if len(self.warnings) < MAX_MISTAKES:
            self.warnings[path, Mistake(code, message, span, advice)] = None

    def is_first(self, use: tuple[Path, Span]) -> bool:
        """Return whether this is the first report of the use of an unknown name, and remember it."""
        first = use not in self.seen
        self.seen.add(use)
        return first

    def has_mistakes_below(self, path: Path) -> bool:
        """Return whether there is a mistake at a path or below it."""
        return any(where[: len(path)] == path for where, _ in self.mistakes)


class Draws(NamedTuple):
    """What names the draws of an expression: its place, each draw's number in it, the elements of generators around."""

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
    """The robot that the expression is for; None for the team."""
    behavior: str = ""
    """The behavior that the expression belongs to, if any: it knows only its own robot, and must sense all else."""
    path: Path = ()
    local: Mapping[str, Value] = field(default_factory=dict)
    before: Scope | None = None
    """The scope of the decision, for `before(e)`."""
    starting: bool = False
    """Whether this is the start of an episode, where `before(e)` is e."""
    draws: Draws | None = None
    """What names its draws; None where nothing may be drawn."""
    static: Callable[[Node], float | None] = lambda _: None
    """The function that gives the value of a node if it is the same for the whole run, else None."""
    size: Callable[[Node], int | None] = lambda _: None
    """The function that gives how many values a node has, if these are 0, 1, and so on; else None."""
    memo: dict[Hashable, Value] = field(default_factory=dict)
    """Values of definitions at this moment."""
    choices: Mapping[str, tuple[Names, ...]] = field(default_factory=dict)
    """For each name that is a value of some state, the lists of names in which it occurs."""
    unseen: dict[Hashable, str] = field(default_factory=dict)
    """For definitions that the behavior cannot know: the first value in them that it cannot know."""

    # These are called most often, so they do not use `replace`, which takes three times as long.

    def at(self, path: Path, robot: int | None = None, *, draws: bool = False) -> Scope:
        """Return the scope of another expression with the same names."""
        named = Draws(".".join(str(part) for part in path)) if draws else None
        return Scope(
            self.graph, self.names, self.findings, self.robots, robot, self.behavior, path,
            {}, self.before, self.starting, named, self.static, self.size, self.memo,
            self.choices, self.unseen,
        )  # fmt: skip

    def inside(self, names: Mapping[str, Value], draws: Draws | None) -> Scope:
        """Return this scope with more names, as for an element of a generator."""
        return Scope(
            self.graph, self.names, self.findings, self.robots, self.robot, self.behavior, self.path,
            {**self.local, **names}, self.before, self.starting, draws, self.static, self.size, self.memo,
            self.choices, self.unseen,
        )  # fmt: skip

    def of_robot(self, robot: int) -> Scope:
        """Return this scope for another robot."""
        return Scope(
            self.graph, self.names, self.findings, self.robots, robot, self.behavior, self.path,
            self.local, self.before, self.starting, self.draws, self.static, self.size, self.memo,
            self.choices, self.unseen,
        )  # fmt: skip

    def static_value(self, node: Node) -> float | None:
        """Return the value of a node if it is the same for the whole run, else None."""
        return float(value_of(node)) if node.literal else self.static(node)

    def mistake(
        self,
        code: str,
        message: str,
        span: Span,
        advice: str = "",
        correction: Rewriting | Enclosing | Addition | None = None,
    ) -> Node:
        """Report a mistake and return the unknown value."""
        self.findings.report(self.path, code, message, span, advice, correction)
        return self.graph.unknown
