"""What an explanation says: layers, their rules, the whole architecture as rows, and what is useless."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from bbsd.language.models import NO_ACTION_TEXT

if TYPE_CHECKING:
    from bbsd.explanation.vocabulary import GlossaryEntry


@dataclass(frozen=True, slots=True)
class Condition:
    """The cells of an input that a rule names, by their indices and as the spec labels them."""

    input: str
    cells: tuple[int, ...]
    labels: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class PlaceInWords:
    """Where something holds: in words, '' everywhere, and the condition for programs as in `RuleInWords`."""

    where: str
    when: tuple[Condition, ...]


@dataclass(frozen=True, slots=True)
class RuleInWords:
    """The decision where a condition holds ('' is otherwise), and whether higher layers always prevent it.

    `when` is the condition for programs: all of its inputs have one of the cells named. `asked` and `controlled` count
    steps of single robots in which the rule was the first to hold while the behavior was asked; None without visits.
    """

    decision: str
    where: str
    when: tuple[Condition, ...]
    overruled: bool = False
    asked: int | None = None
    controlled: int | None = None


@dataclass(frozen=True, slots=True)
class CellsInWords:
    """The number of cells of a table with one decision."""

    decision: str
    cells: int


@dataclass(frozen=True, slots=True)
class NeverAsked:
    """What a table says in cells that were never asked in the episodes looked at; `agrees`: the rules say it too."""

    decision: str
    where: str
    when: tuple[Condition, ...]
    agrees: bool


@dataclass(frozen=True, slots=True)
class CellKinds:
    """How many cells of a table matter to its rules, and why the others do not."""

    count: int
    """Cells in which the rules say what the table says."""
    covered: int
    """Cells in which a higher layer always acts."""
    impossible: int
    """Cells that cannot occur, or not while the behavior is excited."""
    never_asked: int
    """Cells that were never asked in the episodes looked at."""


@dataclass(frozen=True, slots=True)
class InputInWords:
    """An input of a behavior, the labels of its cells, and whether its decisions depend on it where cells count."""

    name: str
    cells: tuple[str, ...]
    matters: bool


@dataclass(frozen=True, slots=True)
class LayerInWords:
    """A layer and its behavior.

    The first rule that holds decides; the last one's condition is always ''. If the rules would be too long to read,
    there are none, and `counted` has the number of cells of each decision instead. `covered` says where the rules have
    an action and higher layers always act before, `effective` where it is left to them; both are empty if that never
    happens or would be too long to read. `overruled_by` names the behaviors that do, highest first. `cells` counts the
    joint cells in which it controls.
    """

    layer: int
    behavior: str
    excited: str | None
    expects: str | None
    inputs: tuple[InputInWords, ...]
    rules: tuple[RuleInWords, ...]
    is_shortest: bool
    """Whether no list of rules has fewer words; else they are those of a greedy search."""
    words: int
    """Decisions and named cells of the rules: what is to be few."""
    table: tuple[str, ...]
    """The decision of each cell, '' where the cell does not count; empty for tables that nobody reads."""
    counted: tuple[CellsInWords, ...]
    kinds: CellKinds
    covered: tuple[PlaceInWords, ...]
    effective: tuple[PlaceInWords, ...]
    overruled_by: tuple[str, ...]
    never_asked: tuple[NeverAsked, ...]
    cells: int | None
    asked: int | None = None
    controlled: int | None = None

    @property
    def acts(self) -> bool:
        """Whether the behavior has an action in any cell that its rules are about."""
        decisions = [rule.decision for rule in self.rules] + [cells.decision for cells in self.counted]
        return any(decision != NO_ACTION_TEXT for decision in decisions)


@dataclass(frozen=True, slots=True)
class Row:
    """A row of the whole architecture: the behavior of this layer does this where the condition holds.

    Of all rows that hold, the one of the highest layer counts. Rows of one layer can be read in any order.
    """

    layer: int
    behavior: str
    decision: str
    where: str
    when: tuple[Condition, ...]
    excited: str | None
    controlled: int | None
    """Steps of single robots in which it decided; None without visits."""


@dataclass(frozen=True, slots=True)
class Useless:
    """Something that a design could do without, as far as tables and visits tell."""

    kind: str
    """`behavior`, `rule` or `input`."""
    behavior: str
    what: str
    """The input or the rule in words, '' for the behavior itself."""
    why: str
    is_certain: bool
    """Whether the tables say so; else it is so in the episodes looked at."""
    number: int | None = None
    """The number of the rule in the file, from 1; None of others."""
    worth: str = ""
    """How the return changes without it, such as `return -0.02 to +0.01`; '' where that was not measured."""


class Watched(NamedTuple):
    """The episodes in which visits were counted."""

    episodes: int
    robot_steps: int
    nobody: int
    """Steps of single robots in which nobody controlled."""


@dataclass(frozen=True, slots=True)
class Explanation:
    """An architecture in words, its layers from the highest down.

    If the joint input space is too large to enumerate, everything that depends on it is empty, and numbers of cells
    are None. `watched` is None where no visits are known.
    """

    name: str
    layers: tuple[LayerInWords, ...]
    left_out: tuple[str, ...]
    joint_size: int
    possible_cells: int | None
    """The joint cells that may occur: those that the expressions of the spec do not exclude."""
    nobody: tuple[PlaceInWords, ...]
    nobody_cells: int | None
    rows: tuple[Row, ...]
    """The whole architecture, the most visited rows first where visits are known; empty if too long to read."""
    useless: tuple[Useless, ...]
    watched: Watched | None
    inputs: tuple[GlossaryEntry, ...]
    actions: tuple[GlossaryEntry, ...]

    def __repr__(self) -> str:
        return f"<Explanation of {self.name}: {' '.join(layer.behavior for layer in self.layers)}>"

    def to_plain(self) -> dict[str, Any]:
        """Return the explanation as plain data for JSON."""
        plain = asdict(self)
        plain["watched"] = None if self.watched is None else self.watched._asdict()
        return plain
