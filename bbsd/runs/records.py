"""What is kept of a run while it goes on: its metrics, a line for each generation, and the state it goes on from."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from bbsd.errors import UsageError
from bbsd.runs import checkpoint

if TYPE_CHECKING:
    from pathlib import Path

    from bbsd.runs.checkpoint import Progress


class FolderError(UsageError):
    """A folder that cannot be written to or gone on from, and what to do about it."""


@dataclass(frozen=True, slots=True)
class Records:
    """The files of one run, in a folder that is made with the first of them."""

    path: Path

    @property
    def metrics(self) -> Path:
        """One line for each generation."""
        return self.path / "metrics.jsonl"

    @property
    def _checkpoint(self) -> Path:
        return self.path / "checkpoint.npz"

    def save(self, progress: Progress, line: dict[str, Any] | None) -> None:
        """Note a generation: first its metrics, then the state, so the state never knows more than the metrics."""
        self.path.mkdir(exist_ok=True)
        if line is not None:
            with self.metrics.open("a", encoding="utf-8") as file:
                file.write(json.dumps(line) + "\n")
        checkpoint.save(self._checkpoint, progress)

    def progress(self) -> Progress | None:
        """The last state that was saved, with the metrics cut back to it; None if there is none.

        Raises FolderError for a damaged checkpoint.
        """
        if not self._checkpoint.exists():
            self.metrics.unlink(missing_ok=True)
            return None
        try:
            progress = checkpoint.load(self._checkpoint)
        except checkpoint.CheckpointError as error:
            raise FolderError(f"{error}; remove the folder to start again") from None
        lines = [line for line in self.lines() if line["generation"] <= progress.state.generation]
        text = "".join(json.dumps(line) + "\n" for line in lines)
        self.metrics.write_text(text, encoding="utf-8")
        return progress

    def lines(self) -> list[dict[str, Any]]:
        """The metrics so far; a last line that was cut off is left out.

        Raises FolderError for a file that is damaged.
        """
        if not self.metrics.exists():
            return []
        whole = [
            line
            for line in self.metrics.read_text(encoding="utf-8").splitlines(keepends=True)
            if line.endswith("\n")
        ]
        try:
            return [json.loads(line) for line in whole]
        except ValueError:
            raise FolderError(f"{self.metrics} is damaged; remove the folder to start again") from None
