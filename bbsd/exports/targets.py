"""The targets of `bbsd export`: a line for each says what it is, what writes it, and through what it is verified."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

from bbsd.exports import btcpp, python, pytrees, ros2
from bbsd.exports.sensing import header
from bbsd.exports.verification.behaviortree import most_cells_of_btcpp, run_btcpp
from bbsd.exports.verification.compilers import run_gcc
from bbsd.exports.verification.interpreters import run_cpython, run_micropython
from bbsd.exports.verification.pytrees import most_cells_of_pytrees, run_pytrees
from bbsd.exports.verification.tools import Runner

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from bbsd.exports.exported import Exported, Files, Options


class Target(NamedTuple):
    """Another language: what a file of it is, who writes it, and what runs it; nothing where it cannot be verified."""

    title: str
    write: Callable[[Exported, Options], Files]
    runners: tuple[Runner, ...]


TARGETS: Mapping[str, Target] = MappingProxyType(
    {
        "c": Target(
            "a C99 header: whole numbers only, or with sensors and assignments in binary64",
            header.write,
            (Runner("gcc", run_gcc),),
        ),
        "python": Target(
            "a Python module without dependencies, also for MicroPython",
            python.write,
            (Runner("python", run_cpython), Runner("micropython", run_micropython, needed=False)),
        ),
        "btcpp": Target(
            "a tree of BehaviorTree.CPP 4 in XML, which Groot2 shows",
            btcpp.write,
            (Runner("behaviortreepy", run_btcpp, most_cells=most_cells_of_btcpp),),
        ),
        "pytrees": Target(
            "a Python module that builds a tree of py_trees",
            pytrees.write,
            (Runner("py_trees", run_pytrees, most_cells=most_cells_of_pytrees),),
        ),
        "ros2": Target("a node of ROS 2 around the Python module, which nothing here runs", ros2.write, ()),
    }
)
"""By the names that `--to` takes."""
