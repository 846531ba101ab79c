"""What every engine can do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from concurrent.futures import Future

    from bbsd.engines.units import Result, Unit

ATTEMPTS = 4
"""Workers that a unit may lose in a row without getting any further; it is then the unit that kills them."""


class WorkerLost(Exception):
    """A worker that ended while it was doing a unit."""


class Engine(Protocol):
    """Workers somewhere, which do units."""

    shares_machine: bool
    """Whether workers are processes of this machine, so that this process is one of as many as were wanted."""

    def capacity(self) -> int:
        """Return how many units can be done at the same time now; it may change, and be 0 for a while.

        It is asked again and again, so an engine may use it to see whether workers are still there.
        """

    def submit(self, unit: Unit) -> Future[Result]:
        """Let a worker do a unit.

        The future raises WorkerLost where the worker was lost, OtherVersion where it has another version of bbsd, and
        whatever the unit's own work raised.
        """

    def prepare(self, unit: Unit) -> None:
        """Let workers get ready for units such as this one, where that can be done before there are any."""

    def dismiss(self) -> None:
        """Let workers end that nothing more will be submitted to."""

    def stop(self) -> None:
        """Ask all workers to stop soon; from any thread."""
