"""An environment that is stepped in Python: which one, what it shows, and what it is told; nothing is imported here."""

from __future__ import annotations

import re
from keyword import iskeyword
from math import isfinite
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal, NamedTuple, get_args

from pydantic import AfterValidator, BeforeValidator, Discriminator, Tag
from pydantic_core import PydanticCustomError

from bbsd.expression.syntax.mistakes import KEY, WHOLE, Mistake, Rewriting
from bbsd.language.base import Entries
from bbsd.language.field_types import ValueNameText, kind_of, shape, value_name, word_list_or_number

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.text import Data

EARNED: Final = "earned"
"""The name of what the environment rewards."""
ENDED: Final = "ended"
"""The name of the slot that says whether the environment has ended; no expression can use it."""
UNUSED: Final = "_"
"""What stands in a list for a number that is not used."""

OutsideKind = Literal["gymnasium", "pettingzoo", "python"]
"""The library that knows how to make and to step an environment."""
OUTSIDE_KINDS: tuple[OutsideKind, ...] = get_args(OutsideKind)

ObservationPath = tuple[str | int, ...]
"""Where a number stands in an observation: keys of mappings, and indices of tuples and arrays."""


class Field(NamedTuple):
    """A number of an observation.

    With a `size` it is a whole number from 0 to `size - 1`: a digit of a discrete observation, the first the most
    significant, or an item of several discrete ones. With a `path` it stands there. With neither it stands where its
    place among the fields says, in C order.
    """

    name: str
    size: int | None = None
    path: ObservationPath | None = None

    @property
    def is_used(self) -> bool:
        """Whether the number has a name."""
        return self.name != UNUSED


class Outside(NamedTuple):
    """An environment that is stepped in Python: its target, the keyword arguments of its making, what it exchanges.

    `fields` are all numbers of the observation that the spec tells of, in the spec's order, those without a name too;
    `actions` the state that is sent, in the order in which it is sent.
    """

    kind: OutsideKind
    target: str
    arguments: Mapping[str, Data]
    fields: tuple[Field, ...]
    actions: tuple[str, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The names that the environment sets for each robot: the used fields in order, then `earned`."""
        return (*(field.name for field in self.fields if field.is_used), EARNED)


IDENTIFIER = r"[A-Za-z_]\w*"
MODULE = rf"{IDENTIFIER}(?:\.{IDENTIFIER})*"
TARGETS: Mapping[OutsideKind, str] = {
    "gymnasium": rf"(?:{MODULE}:)?(?:[\w-]+/)?[\w.-]*\w-v\d+",
    "pettingzoo": rf"{MODULE}\.{IDENTIFIER}_v\d+",
    "python": rf"{MODULE}:{IDENTIFIER}",
}
"""What the names of environments look like."""
EXAMPLES: Mapping[OutsideKind, str] = {
    "gymnasium": "CartPole-v1 or namespace/Name-v1",
    "pettingzoo": "mpe2.simple_spread_v3, the module and in it the environment with its version",
    "python": "my_module:Arena, the module and in it the class",
}


def is_target(kind: OutsideKind, name: str) -> bool:
    """Return whether an environment of a kind may have such a name."""
    return re.fullmatch(TARGETS[kind], name, re.ASCII) is not None


KEY_IN_PATH = r"[^.,\[\]\s][^.,\[\]]*"
INDICES_IN_PATH = r"\[\s*\d{1,9}(?:\s*,\s*\d{1,9})*\s*\]"
PATH = rf"(?:{KEY_IN_PATH}|{INDICES_IN_PATH})(?:\.{KEY_IN_PATH}|{INDICES_IN_PATH})*"
SEGMENT = r"\.?(?P<key>[^.,\[\]]+)|\[(?P<indices>[^\]]*)\]"


def read_path(text: str) -> ObservationPath | None:
    """Return the path that `image[3,5,0]` is: ("image", 3, 5, 0); None for a text that is no path."""
    if not re.fullmatch(PATH, text, re.ASCII):
        return None
    path: list[str | int] = []
    for segment in re.finditer(SEGMENT, text):
        path += (
            [segment["key"].strip()]
            if segment["key"]
            else [int(index) for index in segment["indices"].split(",")]
        )
    return tuple(path)


def read_fields(observation: list[str] | dict[str, int | str]) -> tuple[Field, ...]:
    """Return the fields that an observation is written as."""
    if isinstance(observation, list):
        return tuple(map(Field, observation))
    return tuple(
        Field(name, path=read_path(source)) if isinstance(source, str) else Field(name, size=source)
        for name, source in observation.items()
    )


def _refuse(code: str, message: str, advice: str, at_key: bool = False) -> PydanticCustomError:
    mistake = Mistake(code, message, KEY if at_key else WHOLE, advice)
    return PydanticCustomError("mistake", "{message}", {"message": message, "mistake": mistake})


def _meant(kind: OutsideKind, value: str) -> str:
    """Return the environment that a name probably means: with a version, a class in a module; else ''."""
    text = value.strip().removesuffix(".py").replace("/", ".")
    called = re.fullmatch(r"(?:\w+\.)?make\([\"'](.+?)[\"'].*\)", value.strip())
    if kind == "python":
        module, _, name = text.rpartition(".")
        if name[:1].isupper():
            text = f"{module}:{name}"
        elif ":" not in text:
            text = f"{text}:{''.join(part.capitalize() for part in name.split('_'))}"
    elif called:
        text = called[1]
    else:
        text = f"{value}-v1" if kind == "gymnasium" else f"{value}_v1"
    return text if is_target(kind, text) else ""


def _target(kind: OutsideKind) -> BeforeValidator:
    def checked(value: object) -> object:
        if value is None or (isinstance(value, str) and is_target(kind, value)):
            return value
        what = f'"{value}"' if isinstance(value, str) else kind_of(value)
        advice, correction = f"write {EXAMPLES[kind]}", None
        if meant := _meant(kind, str(value)):
            advice = f"write {meant}, or the one that is meant: {EXAMPLES[kind]}"
            correction = Rewriting(meant, WHOLE, is_certain=False)
        message = f"{what} cannot be the name of an environment"
        mistake = Mistake("BB102", message, WHOLE, advice, correction)
        raise PydanticCustomError("mistake", "{message}", {"message": message, "mistake": mistake})

    return BeforeValidator(checked)


def _argument(value: object) -> object:
    if _is_plain(value):
        return value
    raise _refuse(
        "BB103", "infinity and NaN cannot be given", "give a number, a truth, a text, a list or a mapping"
    )


def _is_plain(value: object) -> bool:
    match value:
        case dict():
            return all(map(_is_plain, value.values()))
        case list():
            return all(map(_is_plain, value))
        case float():
            return isfinite(value)
    return value is None or isinstance(value, str | int)


def _argument_name(key: str) -> str:
    if key.isidentifier() and not iskeyword(key):
        return key
    message = f'"{key}" cannot be the name of an argument in Python'
    raise _refuse(
        "BB103", message, "an argument's name is letters, digits and _, as max_episode_steps", at_key=True
    )


def _field_name(value: str) -> str:
    return value if value == UNUSED else value_name(value)


def _field_source(value: object) -> object:
    match value:
        case bool() | None:
            pass
        case int() if value >= 1:
            return value
        case float() if value >= 1 and value.is_integer():
            return int(value)
        case str():
            if read_path(value) is not None:
                return value
            advice = (
                "write keys and, in brackets, indices from 0 on: image[3,5,0], pose.x, or [0] for a tuple"
            )
            raise _refuse("BB110", f'"{value}" is no path into an observation', advice)
    shown = f"{value:g}" if isinstance(value, int | float) and not isinstance(value, bool) else kind_of(value)
    advice = "write how many values it has, such as 5 for 0 to 4; or the path where it stands, such as image[3,5,0]"
    raise _refuse("BB109", f"a size is a whole number from 1 on, not {shown}", advice)


GymnasiumText = Annotated[str, _target("gymnasium")]
PettingZooText = Annotated[str, _target("pettingzoo")]
PythonText = Annotated[str, _target("python")]

ArgumentText = Annotated[Any, BeforeValidator(_argument)]
"""Plain data: a number, a truth, a text, nothing, a list or a mapping of them."""

ArgumentsText = Entries[Annotated[str, AfterValidator(_argument_name)], ArgumentText]

FieldName = Annotated[str, AfterValidator(_field_name)]
"""A name that expressions can use, or `_`."""

FieldSource = Annotated[int | str, BeforeValidator(_field_source)]
"""A field's size or its path."""

ObservationText = Annotated[
    Annotated[list[FieldName], Tag("<other>")]
    | Annotated[Entries[ValueNameText, FieldSource], Tag("<mapping>")],
    Discriminator(shape),
]
"""A name for each number in C order; sizes; or paths."""

ActionText = Annotated[
    Annotated[str, Tag("<word>")] | Annotated[list[str], Tag("<list>")], Discriminator(word_list_or_number)
]
"""State that is sent to the environment."""
