"""All methods by name."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING

from bbsd.solver.methods import auto, cross_entropy, hill, joint, practice, random_search, societies
from bbsd.solver.methods.q_learning import q_learning

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.solver.methods.method import Method

_METHODS: tuple[Method, ...] = (
    auto.METHOD,
    societies.METHOD,
    cross_entropy.METHOD,
    practice.METHOD,
    random_search.METHOD,
    hill.METHOD,
    joint.METHOD,
    q_learning.METHOD,
)

METHODS: Mapping[str, Method] = MappingProxyType({method.name: method for method in _METHODS})
"""The methods behind the interface, as `design.method` names them."""
