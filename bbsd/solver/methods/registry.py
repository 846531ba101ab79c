"""All methods by name."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING

from bbsd.solver.methods import hill, random_search

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.solver.methods.method import Method

METHODS: Mapping[str, Method] = MappingProxyType(
    {method.name: method for method in (random_search.METHOD, hill.METHOD)}
)
"""The methods behind the interface, as `design.method` names them."""
