"""Faults at every write, fsync, replace and opening of a file of a small design, and what a resumed one makes of it."""

import errno
import os
import subprocess
import sys

import pytest

import bbsd
from bbsd import files
from bbsd.errors import UsageError
from bbsd.runs.storage import records
from bbsd.runs.storage.records import FolderError

SPEC = """
bbsd: 1
name: guess
environment:
  steps: 2
  state: {at: "integers(0, 3)", said: 0}
  sensors: {seen: "values(at, 0, 3)"}
behaviors:
  odd: {inputs: [seen], actions: {one: {said: 1}, three: {said: 3}}}
  even: {inputs: [seen], actions: {none: {said: 0}, two: {said: 2}}}
reward: {right: 1 if said == at else 0}
design:
  answer: {candidates: 5, episodes: 100, judged: 100}
"""
PAPER = (
    "design.method=paper", "design.coevolution.generations=2", "design.coevolution.population=4",
    "design.coevolution.agents=8", "design.learning.episodes=3", "design.learning.last=3",
)  # fmt: skip
RANDOM = ("design.method=random", "design.budget=5000")
CALLS = ("open", "write", "fsync", "replace")
STEP = 3
"""Of the calls, every third has a fault, another third for each kind of fault and method."""


class Killed(BaseException):
    """As if the process ended here."""


class System:
    """The system's functions, one call of which fails."""

    def __init__(self, failing=0, error=None):
        self.calls = 0
        self._failing, self._error = failing, error

    def __getattr__(self, name):
        real = getattr(os, name)
        return self._counted(real) if name in CALLS else real

    def _counted(self, real):
        def call(*arguments, **options):
            if real is os.open and arguments[1] & (os.O_WRONLY | os.O_RDWR) == 0:
                return real(*arguments, **options)  # it only reads
            self.calls += 1
            if self.calls == self._failing or (
                isinstance(self._error, Killed) and 0 < self._failing < self.calls
            ):
                raise self._error  # after a kill nothing is written any more
            return real(*arguments, **options)

        return call


def design(spec, out, settings, system, *, resume=False):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(files, "os", system)
        patch.setattr(records, "os", system)
        patch.setattr(records, "INTERVAL", 0.0)
        return bbsd.design(spec, seed=1, runs=2, out=out, set=settings, resume=resume)


def written(out):
    return [(out / name).read_bytes() for name in ("architecture.yaml", "metrics.jsonl", "spec.yaml")]


@pytest.fixture
def spec(tmp_path):
    path = tmp_path / "guess.yaml"
    path.write_text(SPEC)
    return path


@pytest.mark.slow
@pytest.mark.parametrize("settings", [PAPER, RANDOM], ids=["paper", "random"])
@pytest.mark.parametrize(
    "error", [Killed(), OSError(errno.ENOSPC, "No space left on device")], ids=["kill", "fail"]
)
def test_a_fault_costs_nothing_that_a_resumed_design_does_not_make_good(spec, tmp_path, settings, error):
    undisturbed = System()
    design(spec, tmp_path / "whole", settings, undisturbed)
    expected = written(tmp_path / "whole")
    assert undisturbed.calls > 50
    begin = 1 + (settings is PAPER) + isinstance(error, Killed)
    for number in range(begin, undisturbed.calls + 1, STEP):
        out = tmp_path / f"{number}"
        with pytest.raises((Killed, OSError, FolderError)):
            design(spec, out, settings, System(number, error))
        try:
            design(spec, out, settings, System(), resume=True)
        except UsageError as refused:
            assert "start it without --resume" in str(refused)  # noqa: PT017
            design(spec, out, settings, System())
        assert written(out) == expected, f"call {number}"


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="the system cannot fork processes")
@pytest.mark.parametrize(
    "options",
    [
        "calls --case 1 --step 40",
        "calls --case 5 --step 80",
        "calls --case 8 --step 120",
        "kills --kills 3",
        "races --races 1",
    ],
)
def test_a_cut_of_all_faults(options):
    command = [sys.executable, "-m", "fuzzing.faults", *options.split()]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert " 0 wrong" in ended.stdout
