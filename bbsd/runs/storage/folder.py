"""A design's folder: plain files that anything can open, and from which a run that was stopped is resumed."""

from __future__ import annotations

import json
import platform
from dataclasses import dataclass
from hashlib import sha256
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

from bbsd.files import move, read_regular, write_text_whole, write_whole
from bbsd.runs.beginnings import beginning_of_plain
from bbsd.runs.storage.census import TABLES
from bbsd.runs.storage.finished import ARCHITECTURE, BEST, RUN_FILE, SPEC, run_content
from bbsd.runs.storage.records import METRICS, FolderError, Records
from bbsd.runs.storage.unused import is_unused

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from bbsd.runs.beginnings import Beginning
    from bbsd.runs.storage.identity import Identity

FORMAT = 3
"""The format of `run.json`."""
DIGEST = "architecture_sha256"
"""The key of a result under which the digest of the designed spec stands."""


@dataclass(frozen=True, slots=True)
class Folder:
    """The files of a design."""

    path: Path

    @property
    def architecture(self) -> Path:
        """The file of the designed spec."""
        return self.path / ARCHITECTURE

    @property
    def best(self) -> Path:
        """The file of the best design so far, while there is no answer."""
        return self.path / BEST

    @property
    def metrics(self) -> Path:
        """The file with one line for each generation."""
        return self.path / "metrics.jsonl"

    @property
    def run_file(self) -> Path:
        """The file that says what was run, with what, and with which result."""
        return self.path / RUN_FILE

    def records(self, run: int, n_runs: int) -> Records:
        """Return the records of a run, which counts from 0: in the folder itself where it is the only one."""
        return Records(self.path if n_runs == 1 else self.below(f"run-{run + 1}").path)

    def below(self, name: str) -> Folder:
        """Return the folder of a run or a rival below this one.

        Raises FolderError for a link, which is not followed.
        """
        path = self.path / name
        if path.is_symlink():
            raise FolderError(f"{path} is a link, which may lead anywhere; remove it to go on")
        return Folder(path)

    def gather(self, n_runs: int) -> None:
        """Write the metrics and the tables of all runs, in their order, into one file each."""
        if n_runs == 1:
            return
        folders = [self.records(run, n_runs).path for run in range(n_runs)]
        write_whole(self.metrics, b"".join(read_regular(folder / METRICS) for folder in folders))
        for name in TABLES:
            tables = [read_regular(folder / name) for folder in folders if (folder / name).exists()]
            if tables:  # the names of the columns stand in the first line of each
                rest = (table.partition(b"\n")[2] for table in tables[1:])
                write_whole(self.path / name, b"".join([tables[0], *rest]))

    def begin(self, text: str) -> None:
        """Keep the spec as it is when the design begins; the folder is locked.

        Raises:
            FolderError: another design was written into the folder before it was locked.
        """
        if not is_unused(self.path):
            raise FolderError(not_empty_text(self.path))
        self.run_file.unlink(missing_ok=True)  # of a design that ended before its first step was kept
        write_text_whole(self.path / SPEC, text)

    def write_architecture(self, text: str) -> None:
        """Write the designed spec; one that was edited since is kept, beside a new one where there is one.

        The digest in `run.json` proves that a file is what was written.
        """
        recorded, content = self.result().get(DIGEST), text.encode()
        there = read_regular(self.architecture) if self.architecture.exists() else b""
        is_cut = content.startswith(there)  # or whole: it was written just before a kill
        if not is_cut and recorded and sha256(there).hexdigest() != recorded:
            if digest_of(text) == recorded:
                return
            move(self.architecture, self.path / "architecture.edited.yaml")
        if there != content:
            write_whole(self.architecture, content)
        self.best.unlink(missing_ok=True)

    def write_best(self, text: str) -> Path:
        """Write the best design so far of runs that were stopped, and return its file."""
        write_text_whole(self.best, text)
        return self.best

    def design(self) -> Design:
        """Return what this is the design of. Raises FolderError where it is none."""
        content, spec = self.read_run_file(), self.path / SPEC
        seed, runs, overrides = content.get("seed"), content.get("runs"), content.get("set")
        if (
            not isinstance(seed, int)
            or not isinstance(runs, int)
            or not isinstance(overrides, list)
            or not spec.exists()
        ):
            raise FolderError(f"{self.path} is not the folder of a design")
        return Design(spec, seed, runs, tuple(map(str, overrides)))

    def result(self) -> dict[str, Any]:
        """Return the result that `run.json` holds, empty where there is none."""
        result = self.read_run_file().get("result")
        return result if isinstance(result, dict) else {}

    def budgets(self) -> tuple[int, ...]:
        """Return the budgets that `run.json` holds. Raises FolderError where they are none."""
        budgets = self.read_run_file().get("budgets", [])
        if not isinstance(budgets, list) or not all(type(each) is int and each > 0 for each in budgets):
            raise FolderError(f"the budgets in {self.run_file} are damaged; remove the folder to start again")
        return tuple(budgets)

    def beginnings(self) -> tuple[Beginning, ...]:
        """Return the known designs that `run.json` holds. Raises FolderError where they are none."""
        try:
            return tuple(beginning_of_plain(each) for each in self.read_run_file().get("starts", []))
        except (TypeError, AttributeError):
            raise FolderError(
                f"the starts in {self.run_file} are damaged; remove the folder to start again"
            ) from None

    def lines(self) -> list[dict[str, Any]]:
        """Return the metrics of all generations. Raises FolderError for a damaged file."""
        return Records(self.path).lines()

    def write_run_file(
        self,
        who: Identity,
        overrides: Sequence[str] = (),
        budgets: Sequence[int] = (),
        result: dict[str, Any] | None = None,
        fickle: str | None = None,
        beginnings: Sequence[Beginning] = (),
    ) -> None:
        """Write `run.json`, with the result once there is one.

        Args:
            who: what the run is.
            overrides: as the command had them.
            budgets: of each run, one after another.
            result: what came out.
            fickle: why an environment in Python does not repeat its episodes, '' where it does; None without one.
            beginnings: the known designs that it begins with.
        """
        content = {
            "format": FORMAT,
            **who.plain(),
            "set": list(overrides),
            **({"starts": [each.plain() for each in beginnings]} if beginnings else {}),
            **({"budgets": list(budgets)} if budgets else {}),
            "versions": {name: version(name) for name in ("numba", "numpy", "llvmlite")},
            "machine": {
                "python": platform.python_version(),
                "system": platform.system(),
                "processor": platform.machine(),
            },
            **({} if fickle is None else {"reproducible": not fickle}),
            **({"not_reproducible": fickle} if fickle else {}),
            **({} if result is None else {"result": result}),
        }
        write_text_whole(self.run_file, json.dumps(content, indent=2) + "\n")

    def read_run_file(self) -> dict[str, Any]:
        """Return the content of `run.json`, empty where there is none or it is damaged."""
        return run_content(self.path)

    def holds(self, who: Identity) -> bool:
        """Return whether this is the folder of that design, by this version and revision."""
        return _agrees(self.read_run_file(), who.plain())

    def holds_other_version(self, who: Identity) -> bool:
        """Return whether this is the folder of the same spec, seed and runs by another version."""
        content = self.read_run_file()
        chosen = who.command()
        if "spec" not in content and "spec_sha256" in content:  # format 2 had a digest of the text
            del chosen["spec"]
        return _agrees(content, chosen) and not self.holds(who)


@dataclass(frozen=True, slots=True)
class Design:
    """What a folder is the design of."""

    spec: Path
    seed: int
    runs: int
    overrides: tuple[str, ...]


def digest_of(text: str) -> str:
    """Return the digest of a text that proves that a file of it is whole."""
    return sha256(text.encode()).hexdigest()


def _agrees(content: Mapping[str, Any], expected: Mapping[str, Any]) -> bool:
    return all(content.get(key) == value for key, value in expected.items())


def not_empty_text(path: Path) -> str:
    """Return what is said of a folder that is not empty."""
    choice = ", or continue it with --resume" if (path / RUN_FILE).is_file() else ""
    return f"{path} is not empty; nothing is overwritten: choose another --out{choice}"
