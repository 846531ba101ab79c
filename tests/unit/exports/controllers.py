"""Small controllers with any names, for tests that try many of them."""

from itertools import product
from math import prod

from hypothesis import strategies as st

from bbsd.architecture.controller import Action, Controller, Dimension, Layer, command
from bbsd.exports.exported import Exported

TEXTS = st.one_of(
    st.sampled_from(
        [
            "place",
            "action",
            "name",
            "true",
            "ID",
            "root",
            "get",
            "class",
            "--",
            "-->",
            "<a b='c'>&\"",
            "{x}",
            "Größe 中",
        ]
    ),
    st.text(max_size=6),
    st.just("x" * 200),
)


@st.composite
def controllers(draw):
    """A design of up to three layers over up to three dimensions."""
    dimensions = draw(st.lists(dimension(), max_size=3, unique_by=lambda each: each.name))
    counts = draw(st.lists(st.integers(1, 3), max_size=3))
    actions = tuple(
        Action(draw(TEXTS), f"behavior {index}", draw(st.dictionaries(TEXTS, TEXTS, max_size=2)))
        for index, count in enumerate(counts)
        for _ in range(count)
    )
    layers = tuple(
        draw(layer(dimensions, index, sum(counts[:index]), count)) for index, count in enumerate(counts)
    )
    return Controller(draw(TEXTS), "0" * 32, tuple(dimensions), layers, actions)


@st.composite
def dimension(draw):
    kind = draw(st.sampled_from(["named", "truth", "condition"]))
    if kind == "named":
        cells = tuple(draw(st.lists(TEXTS, min_size=1, max_size=5, unique=True)))
        return Dimension(draw(TEXTS), cells, draw(TEXTS), is_condition=False)
    cells = ("false", "true") if kind == "truth" else ("not excited", "excited")
    return Dimension(draw(TEXTS), cells, draw(TEXTS), is_condition=kind == "condition")


@st.composite
def layer(draw, dimensions, index, first_action, n_actions):
    axes = tuple(draw(st.lists(st.sampled_from(range(len(dimensions))), unique=True))) if dimensions else ()
    truths = [axis for axis, each in enumerate(dimensions) if each.size == 2]
    excitement = draw(st.sampled_from([None, *truths]))
    sizes = tuple(dimensions[axis].size for axis in axes)
    table = draw(st.lists(st.integers(0, n_actions), min_size=prod(sizes), max_size=prod(sizes)))
    return Layer(
        number=index + 1,
        behavior=f"behavior {index}",
        excited=None if excitement is None else "x > 0",
        axes=axes,
        sizes=sizes,
        excitement=excitement,
        excited_at=1 if excitement is None else draw(st.integers(0, 1)),
        table=bytes(table),
        first_action=first_action,
        n_actions=n_actions,
    )


def exported(controller):
    """What writers take that look at the controller alone."""
    fixed = tuple(dict.fromkeys([*each.sets][:1], 0.5) for each in controller.actions)
    return Exported(controller, {}, None, None, fixed)


def joint_cells(controller):
    """All joint cells, and the number of the controlling action in each."""
    cells = list(product(*map(range, controller.sizes)))
    return cells, [command(controller, cell) for cell in cells]
