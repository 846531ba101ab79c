"""Designs of worlds that are stepped in Python, from the command line to the files."""

import json
import signal
import subprocess
import sys
import time
from itertools import count

import pytest

import bbsd as verbs
from bbsd.expression.node_data import Slot
from tests.end_to_end.commands import bbsd, process

NUMBERS = count(1)
ARENA = """\
import os
import random
import time


class Arena:
    \"\"\"A place on a ring, which drifts; home is 0.\"\"\"

    def __init__(self, size=6, fickle=False, slow_at=None, fails_at=None):
        self.size, self.fickle, self.slow_at, self.fails_at = size, fickle, slow_at, fails_at

    def reset(self, *, seed):
        self.random = random.Random(seed + (os.getpid() if self.fickle else 0))
        self.place, self.steps = self.random.randrange(self.size), 0
        return [self.place], {}

    def step(self, action):
        self.steps += 1
        if self.steps == self.slow_at:
            time.sleep(60)
        if self.steps == self.fails_at:
            raise RuntimeError("the ring broke")
        self.place = (self.place + action + self.random.choice([0, 0, 1])) % self.size
        return [self.place], float(self.place == 0), False, self.steps == 12, {}
"""
SPEC = """\
bbsd: 1
name: ring
environment:
  python: {module}:Arena
  with: {arguments}
  steps: 20
  observation: [place]
  action: turn
  state: {{turn: 0}}
behaviors:
  go:
    inputs: {{place: "values(round(place), 0, 5)"}}
    actions: {{back: {{turn: -1}}, forth: {{turn: 1}}}}
  rest:
    inputs: {{home: place == 0}}
    actions: {{stay: {{turn: 0}}}}
reward: {{earned: earned}}
design: {{budget: 5000}}
"""


@pytest.fixture
def ring(tmp_path):
    """A folder with an arena of its own name, and its spec; the options that allow it."""
    return made(tmp_path)


def made(folder, arguments="{}"):
    module = f"ring_{next(NUMBERS)}"
    (folder / f"{module}.py").write_text(ARENA, encoding="utf-8")
    spec = folder / "ring.yaml"
    spec.write_text(SPEC.format(module=module, arguments=arguments), encoding="utf-8")
    return spec, ("--allow-import", module, "--import-from", folder)


def design(spec, out, *words):
    code, printed, err = bbsd("design", spec, "--out", out, "-q", *words)
    assert code == 0, err
    return printed, err


def files(folder):
    return [(folder / name).read_bytes() for name in ("architecture.yaml", "metrics.jsonl")]


@pytest.mark.slow
def test_the_same_design_twice_by_other_lanes_and_jobs_and_after_a_kill(ring, tmp_path):
    spec, allowed = ring
    printed, _ = design(spec, tmp_path / "one", *allowed)
    assert "not reproducible" not in printed
    expected = files(tmp_path / "one")
    for name, further in {"lanes": ("--lanes", 7), "jobs": ("--jobs", 2)}.items():
        design(spec, tmp_path / name, *allowed, *further)
        assert files(tmp_path / name) == expected, name
    killed = tmp_path / "killed"
    with process("design", spec, "--out", killed, *allowed, cwd=tmp_path) as running:
        deadline = time.monotonic() + 60
        while not (killed / "checkpoint.npz").exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        running.send_signal(signal.SIGKILL)
    assert not (killed / "architecture.yaml").exists()
    design(spec, killed, *allowed, "--resume")
    assert files(killed) == expected
    run = json.loads((killed / "run.json").read_text(encoding="utf-8"))
    assert run["reproducible"] is True
    assert run["environment"]["observation space"] == "Box(-inf, inf, (1,), int64)"


@pytest.mark.slow
def test_a_design_is_evaluated_traced_and_drawn(ring, tmp_path):
    spec, allowed = ring
    design(spec, tmp_path / "run", *allowed)
    files_written = ("--trace", tmp_path / "trace.csv", "--returns", tmp_path / "returns.csv")
    code, out, err = bbsd(
        "evaluate", tmp_path / "run", *allowed, "--episodes", 200, *files_written, "--episode", "worst"
    )
    assert code == 0, err
    assert "200 episodes of 12 steps" in out
    returns = [
        line.split(",") for line in (tmp_path / "returns.csv").read_text(encoding="utf-8").splitlines()
    ]
    column = returns[0].index("return")
    worst = min(float(row[column]) for row in returns[1:])
    first, start, *steps = (tmp_path / "trace.csv").read_text(encoding="utf-8").splitlines()
    names = first.split(",")
    assert len(steps) == 12
    assert 0 <= float(start.split(",")[names.index("place")]) < 6
    assert sum(float(step.split(",")[names.index("earned")]) for step in steps) == worst


def test_a_trace_agrees_with_the_environment_itself(ring, tmp_path):
    """The same class, stepped by hand with what the trace says was sent."""
    from bbsd.environments.lanes.common import seed_of
    from bbsd.evaluation import episode_key

    spec, allowed = ring
    text = spec.read_text(encoding="utf-8").replace("  rest:", "    rules: [{otherwise: forth}]\n  rest:")
    spec.write_text(
        text.replace("reward:", "    rules: [{otherwise: stay}]\nstructure: [rest, go]\nreward:"),
        encoding="utf-8",
    )
    module = allowed[1]
    traced = verbs.trace(spec, seed=3, episode=5, allow_import=[module], import_from=[tmp_path])
    arena = sys.modules[module].Arena()
    observed, _ = arena.reset(seed=seed_of(episode_key(3, 5)))
    places, earned = traced.values[Slot("place", 0)], traced.values[Slot("earned", 0)]
    assert traced.start[Slot("place", 0)] == observed[0]
    for place, reward, turn in zip(places, earned, traced.values[Slot("turn", 0)], strict=True):
        observed, own, *_ = arena.step(int(turn))
        assert (observed[0], own) == (place, reward)


@pytest.mark.slow
def test_one_that_does_not_repeat_itself_is_designed_and_marked(tmp_path):
    spec, allowed = made(tmp_path, "{fickle: true}")
    printed, _ = design(spec, tmp_path / "run", *allowed)
    assert "not reproducible: the same seed gave another episode in a fresh process" in " ".join(
        printed.split()
    )
    run = json.loads((tmp_path / "run" / "run.json").read_text(encoding="utf-8"))
    assert run["reproducible"] is False
    assert "fresh process" in run["not_reproducible"]


@pytest.mark.slow
def test_another_environment_is_not_resumed(ring, tmp_path):
    spec, allowed = ring
    design(spec, tmp_path / "run", *allowed)
    run = tmp_path / "run" / "run.json"
    content = json.loads(run.read_text(encoding="utf-8"))
    content["environment"] |= {"source": "0" * 16, "gymnasium": "0.29"}
    run.write_text(json.dumps(content), encoding="utf-8")
    code, _, err = bbsd("design", spec, "--out", tmp_path / "run", "--resume", *allowed)
    assert code == 2
    assert "the environment's source (0000000000000000, not " in err
    assert "the environment's gymnasium (0.29, not none)" in err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("{slow_at: 3}", "in step 3 of an episode (seed"),
        ("{slow_at: 3}", "did not return within 0.3 s"),
        ("{fails_at: 2}", "raised RuntimeError: the ring broke"),
        ("{fails_at: 2}", 'in step: raise RuntimeError("the ring broke")'),
    ],
)
def test_what_goes_wrong_is_told_without_a_traceback(tmp_path, arguments, words):
    spec, allowed = made(tmp_path, arguments)
    code, out, err = bbsd("evaluate", spec, "--fill", "random", "--agents", 3, "--step-limit", 0.3, *allowed)
    assert (code, out) == (2, "")
    assert words in err
    assert "Traceback" not in err
    assert "bbsd/environments" not in err


@pytest.mark.slow
def test_nor_in_another_process(tmp_path):
    spec, allowed = made(tmp_path, "{slow_at: 3}")
    command = [
        sys.executable,
        "-m",
        "bbsd",
        "design",
        spec,
        "--out",
        tmp_path / "run",
        "--runs",
        "2",
        "--jobs",
        "2",
    ]
    command += ["--step-limit", "0.5", *allowed]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 2
    assert "did not return within 0.5 s" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_value_that_is_not_taken_is_told(tmp_path):
    pytest.importorskip("gymnasium")
    text = SPEC.format(module="a", arguments="{}").replace("python: a:Arena", "gymnasium: FrozenLake-v1")
    text = (
        text.replace("turn: 1}", "turn: place / 2}").replace("turn: -1}", "turn: 3}").replace("0, 5", "0, 15")
    )
    spec = tmp_path / "lake.yaml"
    spec.write_text(text, encoding="utf-8")
    words = ("--fill", "random", "--agents", 20, "--allow-import", "gymnasium")
    code, _, err = bbsd("evaluate", spec, *words, "--step-in-python")
    assert code == 2
    assert "FrozenLake-v1, in step " in err
    assert "and the environment takes a whole number from 0 to 3" in err


def test_a_class_in_hand_needs_no_import(ring):
    class Arena:
        def reset(self, *, seed):
            return [seed % 6], {}

        def step(self, action):
            return [0], 2.0, True, False, {}

    spec, _ = ring
    found = verbs.evaluate(spec, fill="random", agents=2, environment=Arena)
    assert found.mean == 2.0
    shown = verbs.spaces(spec, environment=Arena)
    assert shown.observation == "Box(-inf, inf, (1,), int64)"


STAYING = "[{when: {home: true}, do: stay}, {otherwise: no action}]"


def given(spec, way="forth"):
    """The spec with rules, beside it."""
    text = spec.read_text(encoding="utf-8").replace("  rest:", f"    rules: [{{otherwise: {way}}}]\n  rest:")
    path = spec.with_name(f"{way}.yaml")
    path.write_text(
        text.replace("reward:", f"    rules: {STAYING}\nstructure: [rest, go]\nreward:"),
        encoding="utf-8",
    )
    return path


EXPLAINED = {
    "why": (("why", "{a}", "--episode", "worst", "--step", "3"), "controlled: "),
    "worth": (("worth", "{a}", "--episodes", "20"), "change of the return"),
    "compare": (("compare", "{a}", "{b}", "--episodes", "20"), "go: forth becomes back"),
    "explain": (("explain", "{a}", "--worth", "--episodes", "20"), "2  rest  stay where"),
    "report": (("report", "{a}", "{b}", "--episodes", "20", "-o", "{folder}/page.html"), "page.html"),
}


@pytest.mark.parametrize("words", EXPLAINED)
def test_a_design_is_explained_by_its_episodes(ring, tmp_path, words):
    spec, allowed = ring
    a, b = given(spec), given(spec, "back")
    command, shown = EXPLAINED[words]
    told = [word.format(a=a, b=b, folder=tmp_path) for word in command]
    code, _, err = bbsd(*told)
    assert code == 2
    assert f"--allow-import {allowed[1]}" in err
    code, out, err = bbsd(*told, *allowed)
    assert code == 0, err
    assert shown in out


def test_why_tells_what_was_in_the_episode(ring, tmp_path):
    spec, (_, module, *_) = ring
    opening = {"allow_import": [module], "import_from": [tmp_path]}
    path = given(spec)
    places = verbs.trace(path, episode=2, **opening).values[Slot("place", 0)]
    for step in (2, 3, 4):
        answer = verbs.why(path, episode=2, step=step, **opening)
        assert answer.values["place"] == places[step - 2]
        assert answer.action == ("stay" if places[step - 2] == 0 else "forth")
