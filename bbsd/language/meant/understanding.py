"""What is meant by data whose form is wrong."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.language.meant.actions import blocks_of_assignments, effects_as_texts
from bbsd.language.meant.behaviors.conditions import cells_as_conditions
from bbsd.language.meant.behaviors.dashes import divided_rules, otherwise_apart
from bbsd.language.meant.behaviors.layers import unordered_structure
from bbsd.language.meant.cells import (
    cells_as_lists,
    conditions_as_inputs,
    otherwise_by_another_name,
    ranges_as_conditions,
)
from bbsd.language.meant.declared.definitions import parameters_not_written, rows_of_other_lengths
from bbsd.language.meant.declared.extended import behaviors_of_the_base
from bbsd.language.meant.declared.sensed import what_is_sensed, what_the_world_has
from bbsd.language.meant.declared.starts import fractions_as_indices, truths_as_numbers
from bbsd.language.meant.depth import not_indented, too_deep, too_shallow
from bbsd.language.meant.forms import (
    lists_of_named,
    nameless_actions,
    single_reward,
)
from bbsd.language.meant.keys import methods, options_of_commands, other_names, without_place, wrong_block
from bbsd.language.meant.lists.brackets import lists_as_expressions
from bbsd.language.meant.lists.indices import elements_from_one, elements_in_parentheses
from bbsd.language.meant.names import functions, keys_of_dynamics, names
from bbsd.language.meant.picture import places
from bbsd.language.meant.reading import Reading
from bbsd.language.meant.rules import decisions, mapping_of_rules, parts_of_rules
from bbsd.language.meant.statements import (
    cells_as_texts,
    conditions_as_expressions,
    if_statements,
    values_in_quotes,
)
from bbsd.language.meant.values import (
    blocks_of_costs,
    end_of_one_robot,
    numbers_of_robots,
    steps_in_time,
    values_at_the_start,
    whole_numbers,
)
from bbsd.language.meant.values_by_name import names_at_the_start, sensors_named_as_state

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.language.lineage import Lineage
    from bbsd.text import Data

READINGS: tuple[Callable[[Reading], None], ...] = (
    not_indented,
    too_deep,
    too_shallow,
    divided_rules,
    otherwise_apart,
    options_of_commands,
    other_names,
    wrong_block,
    blocks_of_assignments,
    lists_of_named,
    cells_as_lists,
    without_place,
    single_reward,
    mapping_of_rules,
    unordered_structure,
    nameless_actions,
    effects_as_texts,
    parts_of_rules,
    decisions,
    otherwise_by_another_name,
    ranges_as_conditions,
    conditions_as_inputs,
    numbers_of_robots,
    blocks_of_costs,
    values_at_the_start,
    steps_in_time,
    whole_numbers,
    methods,
    places,
    end_of_one_robot,
    if_statements,
    conditions_as_expressions,
    cells_as_conditions,
    cells_as_texts,
    values_in_quotes,
    lists_as_expressions,
    elements_in_parentheses,
    elements_from_one,
    functions,
    keys_of_dynamics,
    names,
    names_at_the_start,
    sensors_named_as_state,
    behaviors_of_the_base,
    parameters_not_written,
    rows_of_other_lengths,
    fractions_as_indices,
    truths_as_numbers,
    what_is_sensed,
    what_the_world_has,
)
"""What is read as something else, in this order: where blocks stand, then what they are, then what is in them."""
MAX_CHARACTERS = 100_000
"""Of all files together, up to which it is asked what is meant: a longer one takes too long."""


def as_meant(data: dict[str, Data], files: Lineage) -> Reading:
    """Return data as they are meant where their form is wrong in a known way, and what is to be told of it."""
    reading = Reading.of(data, files)
    if files.characters <= MAX_CHARACTERS:
        for read in READINGS:
            read(reading)
    return reading
