"""States that are one of several names: in kernels, traces, reasons, agents and exports."""

from pathlib import Path

import pytest

import bbsd
from bbsd.compiler import compile_meaning
from bbsd.errors import UsageError
from bbsd.evaluation.faults import read_fault
from bbsd.report.csv_text import csv_text
from bbsd.report.figures.choice import choice_of
from tests.end_to_end.test_against_interpreter import compared
from tests.unit.exports.designs import require

MODES = Path(__file__).parent / "specs" / "modes.yaml"
IDLE = {"x": 5.0, "battery": 1.0, "felt": "red", "other": "idle"}


@pytest.fixture(scope="module")
def trace():
    return bbsd.trace(MODES)


@pytest.mark.parametrize("compiled", [False, True])
def test_kernels_mean_what_the_interpreter_reads(compiled):
    meaning = bbsd.load(MODES, seed=5).meaning
    compared(compile_meaning(meaning, compiled=compiled), seed=5, generation=1, n_agents=3, agents_seed=1)


def test_numbers_instead_of_names_are_the_same_episodes(tmp_path):
    text = MODES.read_text(encoding="utf-8")
    named = text[: text.index("behaviors:")].split("state:")[1].split("definitions:")[0]
    by_hand = named.replace(
        "one of [idle, search, home] starting search if robot == 0 else idle", "1 if robot == 0 else 0"
    )
    assert by_hand != named
    with_memory = tmp_path / "by_hand.yaml"
    with_memory.write_text(
        text.replace(named, by_hand)
        .replace("doing: memory", "doing: values(memory, 0, 2)")
        .replace("memory: mode", "memory: 0 if mode == idle else 1 if mode == search else 2")
        .replace("doing: [idle, search, home]", "doing: [0, 1, 2]"),
        encoding="utf-8",
    )
    one, other = (bbsd.evaluate(path, episodes=20) for path in (MODES, with_memory))
    assert one.mean == other.mean


def test_a_trace_tells_names(trace):
    head, start, first, *_ = (line.split(",") for line in csv_text(trace).splitlines())
    place = head.index("mode_0")
    assert (start[place], first[place]) == ("idle", "search")
    assert start[head.index("memory_0")] == "search"
    assert start[head.index("memory_1")] == "idle"
    assert {start[head.index("light")], start[head.index("felt_1")]} <= {"red", "green"}
    lists = [index for index, column in enumerate(head) if column.startswith("all_modes")]
    assert len(lists) == 4
    assert {start[index] for index in lists} == {"idle"}
    assert start[head.index("now_0")] == "idle"


def test_a_figure_has_a_tick_for_each_name(trace):
    (panel,) = choice_of(trace, bbsd.load(MODES).spec, show=["mode"]).panels
    assert panel.cells == ("idle", "search", "home")


def test_reasons_are_asked_with_names():
    at = {
        "mode": "search",
        "felt": "red",
        "tired": True,
        "memory": "idle",
        "other": "idle",
        "at_home": True,
    }
    assert "back" in str(bbsd.why(MODES, at=at))


def test_an_agent_takes_and_gives_names():
    agent = bbsd.Agent(MODES)
    assert agent.act(IDLE).sets == {"mode": "search"}
    assert agent.memory == {"mode": "search", "memory": "search"}
    with pytest.raises(UsageError, match=r"bleu.*none of its values"):
        agent.act({**IDLE, "felt": "bleu"})
    measured = bbsd.Agent(MODES, measured=["mode"])
    assert measured.inputs["mode"].kind == "name"
    assert measured.act({**IDLE, "mode": "home"}).action is None
    assert measured.act({**IDLE, "mode": 0}).action == "seek"


@pytest.mark.parametrize("target", ["c", "python", "btcpp"])
def test_exports_are_equal_in_all_cells(target):
    export = bbsd.export(MODES, target, verify=True, sensing=target == "c")
    for verified in export.verified:
        require(verified)
        assert verified.is_equal, verified
    if target == "c":
        assert "MODES_MEMORY_SEARCH = 1" in export.text
        assert "MODES_MODE_IDLE_2" not in export.text


def test_only_numbers_are_noisy():
    with pytest.raises(UsageError, match="felt"):
        read_fault("sensor=felt:noise(0.1)", bbsd.load(MODES).meaning)
