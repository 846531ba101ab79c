"""The program of many robots with one design, side by side: the same functions in a compiled loop over lanes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from bbsd.agent.inputs import BadInput, complaint_of_names
from bbsd.agent.writing import KEY, STEP, decision_lines, outcome_names
from bbsd.expression.kinds import Kind
from bbsd.expression.nesting import by_name
from bbsd.kernel import functions, streams
from bbsd.kernel.keys import keys
from bbsd.kernel.modules import load_kernel
from bbsd.kernel.streams import fold

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping, Sequence

    import numpy.typing as npt

    from bbsd.agent.inputs import AgentInput
    from bbsd.agent.program import Program
    from bbsd.expression.node_data import Variable

    Floats = npt.NDArray[np.float64]
    Integers = npt.NDArray[np.int64]

FUNCTIONS = ("decide", "outcome", "many")
READ = {Kind.TRUTH: "{} != 0.0", Kind.CELL: "int({})"}
"""How a number in an array becomes a truth or a cell."""
STORED = {Kind.TRUTH: "1.0 if {} else 0.0", Kind.CELL: "float({})"}
"""How a truth or a cell becomes a number in an array."""


class Acts(NamedTuple):
    """What many robots do: the number of each one's action, and the values of state that it sets, by name.

    `numbers` is (n,), 0 where nobody controls; `sets[name]` is (n,), of a list (n, length, ...), truths as 0 and 1, NaN
    where nothing is set.
    """

    numbers: Integers
    sets: dict[str, Floats]


class Many:
    """Many robots side by side, and what each of them keeps."""

    def __init__(self, program: Program, start: Sequence[float], key: int, n: int) -> None:
        self._program = program
        self._many = _compiled(program)
        self._variables = variables_set(program)
        self._start = np.array(start, np.float64).reshape(-1, 1)
        self._keys_of_lanes = keys(key, 0, n)
        self._episodes = np.full(n, -1, np.int64)
        self._kept = np.repeat(self._start, n, axis=1)
        self._steps, self._keys = np.zeros(n, np.int64), np.zeros(n, np.uint64)
        self.reset(np.ones(n, np.bool_))

    def __getstate__(self) -> dict[str, Any]:
        """Return all but the compiled loop, which a copy loads again."""
        return {name: value for name, value in vars(self).items() if name != "_many"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Become a copy."""
        vars(self).update(state)
        self._many = _compiled(self._program)

    @property
    def n(self) -> int:
        """The number of robots."""
        return len(self._steps)

    def reset(self, where: npt.NDArray[np.bool_]) -> None:
        """Let some robots (n,) forget what they keep, and begin a new episode."""
        self._episodes[where] += 1
        self._steps[where] = 0
        self._kept[:, where] = self._start
        words = self._episodes[where].astype(np.uint64)
        self._keys[where] = fold(self._keys_of_lanes[where], words)  # type: ignore[arg-type]  # elementwise

    def act(self, rows: Floats) -> Acts:
        """Return what all robots do, given their inputs (n_values, n), and keep what each has to."""
        numbers, sets = np.zeros(self.n, np.int64), np.full((len(self._variables), self.n), np.nan)
        self._steps += 1
        self._many(np.ascontiguousarray(rows), self._kept, self._steps, self._keys, numbers, sets)
        return Acts(numbers, by_name(self._variables, [*sets], self._program.lengths, _stacked))


def _stacked(rows: list[Floats]) -> Floats:
    return np.stack(rows, axis=1)


def _compiled(program: Program) -> Callable[..., None]:
    """Return the loop over robots."""
    many: Callable[..., None] = load_kernel(loop_source(program), "agent", FUNCTIONS, compiled=True).many
    return many


def variables_set(program: Program) -> list[Variable]:
    """Return the state, and the elements of lists, that some action sets, in the order of the spec's actions."""
    return [*dict.fromkeys(variable for sets in program.needs.sets.values() for variable in sets)]


def loop_source(program: Program) -> str:
    """Return the module's source."""
    used = set[str]()
    decision = program.body(used)
    decision_lines(program.controller, program.needs, decision)
    outcomes = _outcomes(program, used)
    tables = [
        f"TABLE_{layer.number} = np.array({[*layer.table]}, np.uint8)"
        for layer in program.controller.layers
        if len(set(layer.table)) > 1
    ]
    gathers = (
        [f"CONSTANTS = np.array({list(map(float, program.constants))!r})"] if "clamp_index" in used else []
    )
    imports = [
        f"from {home.__name__} import {', '.join(names)}"
        for home in (functions, streams)
        if (
            names := sorted(used & vars(home).keys() - (vars(functions).keys() if home is streams else set()))
        )
    ]
    lines = [
        f'"""Many robots of {program.controller.name!a} side by side."""',
        "",
        "import numpy as np",
        "",
        *imports,
        "",
        "NAN = nan = np.nan",
        "INFINITY = inf = np.inf",
        *tables,
        *gathers,
        "",
        "",
        f"def decide({program.arguments}):",
        *decision.lines,
        "",
        "",
        f"def outcome(number, lane, {program.arguments}, sets, kept):",
        *outcomes,
        "",
        "",
        *_loop(program),
    ]
    return "\n".join(lines) + "\n"


def _outcomes(program: Program, used: set[str]) -> list[str]:
    """Return the body of `outcome`, which stores what an action sets, and what is kept then."""
    lines, rows = list[str](), {variable: row for row, variable in enumerate(variables_set(program))}
    for number in (*program.needs.sets, 0):
        body = program.body(used)
        if number:
            body.say(f"if number == {number}:")
            body = body.inner()
        outcome = outcome_names(program.needs, number, program.kept, body)
        for variable, text in outcome.sets.items():
            kind = program.needs.sets[number][variable].kind
            body.say(f"sets[{rows[variable]}, lane] = {STORED.get(kind, '{}').format(text)}")
        for place, (slot, text) in enumerate(zip(program.kept, outcome.kept, strict=True)):
            kind = program.needs.next[slot].kind
            body.say(f"kept[{place}, lane] = {STORED.get(kind, '{}').format(text)}")
        body.say("return" if number else "pass")
        lines += body.lines
    return lines


def _loop(program: Program) -> list[str]:
    names = [*program.values.values()]
    n_given = len(names) - len(program.kept)
    kinds = [_kind(each) for each in program.inputs.values() for _ in each.slots]
    kinds += [program.needs.next[slot].kind for slot in program.kept]
    lines = ["def many(values, kept, steps, keys, numbers, sets):", "    for lane in range(numbers.size):"]
    for place, (name, kind) in enumerate(zip(names, kinds, strict=True)):
        source = f"values[{place}, lane]" if place < n_given else f"kept[{place - n_given}, lane]"
        lines.append(f"        {name} = {READ.get(kind, '{}').format(source)}")
    return [
        *lines,
        f"        {STEP} = steps[lane]",
        f"        {KEY} = keys[lane]",
        f"        number = decide({program.arguments})",
        "        numbers[lane] = number",
        f"        outcome(number, lane, {program.arguments}, sets, kept)",
    ]


def _kind(each: AgentInput) -> Kind:
    return {"truth": Kind.TRUTH, "cell": Kind.CELL}.get(each.kind, Kind.NUMBER)


def rows_of(
    inputs: Mapping[str, AgentInput], known: Collection[str], given: Mapping[str, Any], n: int | None
) -> Floats:
    """Return what many robots are given as rows (n_values, n), one for each scalar of the inputs.

    Each value is an array whose first axis is the robots', or a single value for all of them.

    Raises:
        BadInput: names are wrong, shapes do not fit, or values are of another kind.
    """
    if problem := complaint_of_names(inputs, known, given):
        raise problem
    arrays = {name: _array(each, given[name]) for name, each in inputs.items()}
    counts = {name: len(array) for name, array in arrays.items() if array.ndim == 1 + len(inputs[name].shape)}
    counts |= {"n": n} if n is not None else {}
    if len({*counts.values()}) > 1:
        told = ", ".join(f"{number} by {name}" for name, number in counts.items())
        raise BadInput(f"the values are for different numbers of robots: {told}")
    count = next(iter(counts.values()), 1)
    rows = [
        np.broadcast_to(arrays[name], (count, *each.shape)).reshape(count, each.size).T
        for name, each in inputs.items()
    ]
    return np.concatenate([np.zeros((0, count)), *rows])


def _array(each: AgentInput, value: Any) -> Floats:  # noqa: ANN401 - whatever was given
    """Return the values of an input as numbers: truths 0 and 1, cells by their index."""
    array = _as_given(each, value)
    if array.shape[array.ndim - len(each.shape) :] != each.shape or array.ndim > 1 + len(each.shape):
        raise BadInput(f"{each.name}: {_needed(each)} is needed, not one of shape {array.shape}")
    if each.kind in ("number", "whole number") and array.dtype.kind in "fiu":
        numbers = array.astype(np.float64)
        if each.kind == "whole number" and (wrong := np.isfinite(numbers) & (numbers % 1 != 0)).any():
            place = int(wrong.argmax())
            raise BadInput(
                f"{_called(each.called, each, array, place)}: {float(numbers.flat[place])!r} is no whole number"
            )
        return numbers
    if each.kind == "truth" and array.dtype == np.bool_:
        return array.astype(np.float64)
    return _read(each, array)


def _as_given(each: AgentInput, value: Any) -> npt.NDArray[Any]:  # noqa: ANN401 - as above
    """Return values as an array; lists in which texts are beside numbers stay what they are."""
    try:
        array = np.asarray(value)
        is_mixed = array.dtype.kind in "US" and not isinstance(value, np.ndarray)
        return np.asarray(value, dtype=object) if is_mixed else array
    except ValueError:
        raise BadInput(f"{each.name}: {_needed(each)} is needed, not lists of different lengths") from None


def _needed(each: AgentInput) -> str:
    return f"an array of {' by '.join(['n', *map(str, each.shape)])} values"


def _read(each: AgentInput, array: npt.NDArray[Any]) -> Floats:
    """Return values of any kind; of those that have an order, each different one is read once."""
    values = array.ravel()
    first = places = np.arange(values.size)
    if values.dtype != object:
        _, first, places = np.unique(values, return_index=True, return_inverse=True)
    found, names = np.zeros(first.size), each.called
    for number in np.argsort(first):  # so that the first wrong one is told
        place = int(first[number])
        found[number] = each.read(values[place : place + 1].tolist()[0], _called(names, each, array, place))
    return found[places].reshape(array.shape)


def _called(names: Sequence[str], each: AgentInput, array: npt.NDArray[Any], place: int) -> str:
    """Return what a value of an array is called, and of which robot it is, where each has one of its own."""
    robot, own = divmod(place, each.size)
    return names[own] + (f" of robot {robot}" if array.ndim > len(each.shape) else "")
