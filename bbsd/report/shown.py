"""What the reports need to know of results that are made above them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from bbsd.evaluation import Evaluation, Interval


class DesignResult(Protocol):
    """A design that was found: how good it is, and where it is written."""

    @property
    def architecture(self) -> Path:
        """The file of the designed spec."""

    @property
    def structure(self) -> Sequence[str]:
        """The behaviors, highest layer first."""

    @property
    def evaluation(self) -> Evaluation:
        """Episodes that took no part in choosing the design."""

    @property
    def lifetime(self) -> Interval:
        """The lifetime fitness of agents with these behaviors."""

    @property
    def random(self) -> Interval:
        """Random agents of the same spec."""

    @property
    def seconds(self) -> float:
        """How long the design took."""


class Generation(Protocol):
    """How far a design is, told when a generation ends; runs and generations count from 1."""

    @property
    def run(self) -> int:
        """The run."""

    @property
    def runs(self) -> int:
        """The number of runs."""

    @property
    def generation(self) -> int:
        """The generation that ended."""

    @property
    def generations(self) -> int:
        """The generations of a run."""

    @property
    def mean(self) -> float:
        """The mean fitness of its agents."""

    @property
    def best(self) -> float:
        """The best agent's fitness."""

    @property
    def lifetime(self) -> float:
        """The mean lifetime fitness."""
