"""What is kept of a run on disk: its metrics, a line for each generation, and the state from which it is resumed."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from bbsd.errors import UsageError
from bbsd.runs import checkpoint

if TYPE_CHECKING:
    from pathlib import Path

    from bbsd.runs.checkpoint import RunState


class FolderError(UsageError):
    """A folder that cannot be written to or resumed; the message says what to do about it."""


@dataclass(frozen=True, slots=True)
class Records:
    """The files of one run. Their folder is made with the first of them."""

    path: Path

    @property
    def metrics(self) -> Path:
        """The file with one line for each generation."""
        return self.path / "metrics.jsonl"

    @property
    def _checkpoint(self) -> Path:
        return self.path / "checkpoint.npz"

    def save(self, reached: RunState, line: dict[str, Any] | None) -> None:
        """Save a generation: first its metrics, then the state, so no state is saved without its metrics."""
        self.path.mkdir(exist_ok=True)
        if line is not None:
            with self.metrics.open("a", encoding="utf-8") as file:
                file.write(json.dumps(line) + "\n")
        checkpoint.save(self._checkpoint, reached)

    def load(self) -> RunState | None:
        """Return the last state that was saved, or None, and cut the metrics back to its generation.

        Raises FolderError for a checkpoint that cannot be resumed.
        """
        if not self._checkpoint.exists():
            self.metrics.unlink(missing_ok=True)
            return None
        try:
            reached = checkpoint.load(self._checkpoint)
        except checkpoint.CheckpointError as error:
            raise FolderError(f"{error}; remove the folder to start again") from None
        lines = [line for line in self.lines() if line["generation"] <= reached.state.generation]
        text = "".join(json.dumps(line) + "\n" for line in lines)
        self.metrics.write_text(text, encoding="utf-8")
        return reached

    def lines(self) -> list[dict[str, Any]]:
        """Return the metrics of all generations so far, without a last line that was cut off.

        Raises FolderError for a damaged file.
        """
        if not self.metrics.exists():
            return []
        complete = [
            line
            for line in self.metrics.read_text(encoding="utf-8").splitlines(keepends=True)
            if line.endswith("\n")
        ]
        try:
            return [json.loads(line) for line in complete]
        except ValueError:
            raise FolderError(f"{self.metrics} is damaged; remove the folder to start again") from None
