"""Whatever a command writes into the folder of a run, it writes while it holds the folder's lock."""

import fcntl
import os
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest

from tests.end_to_end.commands import bbsd

pytest.importorskip("fcntl", reason="the system has no such locks")

SPEC = Path(__file__).parent / "specs" / "thermostat.yaml"
QUICK = ("--set", "design.method=random", "--budget", "5000", "-q")
ODD = SPEC.read_text().replace("bbsd: 1", "bbsd:   1").replace("warmth > 25", "warmth > 25 && warmth > 20")
"""What can be formatted and corrected."""
CHANGES = {"os.rename": (0, 1), "os.remove": (0,), "os.mkdir": (0,), "os.rmdir": (0,), "os.link": (0, 1)}
"""The events of calls that change names, and which of their arguments are paths."""

COMMANDS = [
    ("design", "{run}/spec.yaml", "--resume", "--out", "{run}", "--plot", *QUICK),
    ("design", "{run}", "--more", "5000", "--plot-to", "{run}/search.svg", "-q"),
    ("evaluate", "{run}", "--episodes", "5", "--returns", "{run}/returns.csv"),
    ("evaluate", "{run}", "--episodes", "5", "--trace", "{run}/t.csv", "--plot-to", "{run}/t.png"),
    ("report", "{run}", "--episodes", "5", "-o", "{run}/page.html"),
    ("export", "{run}", "--to", "python", "-o", "{run}/design.py"),
    ("tidy", "{run}", "-o", "{run}/short.yaml"),
    ("fmt", "{run}/odd.yaml"),
    ("check", "{run}/odd.yaml", "--fix"),
    ("new", "{run}/another"),
    ("watch", "{run}", "--tensorboard", "{run}"),
]


class Watching:
    """What is written below a folder, and what of it while nobody holds the folder's lock."""

    def __init__(self):
        self.folder = None
        self.written = []
        self.unlocked = []

    def see(self, event, arguments):
        if self.folder is None:
            return
        if event == "open":
            path, _, flags = arguments
            paths = [path] if flags & (os.O_WRONLY | os.O_RDWR) else []
        else:
            paths = [arguments[place] for place in CHANGES.get(event, ())]
        folder, self.folder = self.folder, None  # what is looked at here is not seen
        try:
            for path in paths:
                self._note(folder, path)
        finally:
            self.folder = folder

    def _note(self, folder, path):
        path = Path(os.fsdecode(path)) if isinstance(path, str | bytes | os.PathLike) else Path(os.devnull)
        if folder in path.parents and path != folder / "lock":
            self.written.append(path.name)
            if not is_locked(folder / "lock"):
                self.unlocked.append(path.name)


WATCHING = Watching()
sys.addaudithook(WATCHING.see)  # for as long as the process lasts


def is_locked(path):
    with path.open("a") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
    return False


@contextmanager
def watching(folder):
    WATCHING.written, WATCHING.unlocked = [], []
    WATCHING.folder = folder
    try:
        yield WATCHING
    finally:
        WATCHING.folder = None


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("designs") / "run"
    with watching(folder) as seen:
        code, _, err = bbsd(
            "design", SPEC, "--out", folder, "--plot", "--tensorboard", folder / "events", *QUICK
        )
    assert (code, err) == (0, "")
    assert seen.unlocked == []
    parts = {name.removeprefix(".").partition(".part")[0].rpartition(".")[0] for name in seen.written}
    assert parts >= {"architecture.yaml", "curves.png", "run.json", "spec.yaml", "visits.json"}
    assert [*(folder / "events").rglob("*tfevents*")]
    return folder


@pytest.fixture(autouse=True)
def odd_specs(run):
    (run / "another.yaml").unlink(missing_ok=True)
    (run / "odd.yaml").write_text(ODD)


@pytest.mark.slow
@pytest.mark.parametrize("words", COMMANDS, ids=lambda words: words[0])
def test_all_is_written_under_the_lock(words, run):
    with watching(run) as seen:
        code, _, err = bbsd(*(word.format(run=run) for word in words))
    assert code == 0, err
    assert seen.written
    assert seen.unlocked == []


@pytest.mark.slow
@pytest.mark.parametrize("words", COMMANDS, ids=lambda words: words[0])
def test_nothing_is_written_where_another_one_holds_the_lock(words, run):
    with (run / "lock").open("a") as holder, watching(run) as seen:
        fcntl.flock(holder, fcntl.LOCK_EX)
        code, _, err = bbsd(*(word.format(run=run) for word in words))
    assert code == 2
    assert "is being written by another process" in err
    assert seen.written == []
