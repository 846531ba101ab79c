import json

import pytest

from bbsd.engines.units import Unit
from bbsd.language.loading import load
from bbsd.runs.rival_command import rival_command
from bbsd.runs.storage import checkpoint
from bbsd.runs.storage.records import METRICS, line_text
from bbsd.runs.storage.state import run_arrays
from bbsd.runs.workers import portions
from bbsd.runs.workers.portions import BEGUN, PREPARE, STATE, WORK, Begun, advance, order_of, prepare
from bbsd.stopping import stop_request_of_context
from bbsd.text import Source
from tests.unit.runs.commands import SENT, command_of, sent_command

START = Begun(0, [], None)


def unit_of(command, state=None, begun=START, seconds=0.0, run=0):
    files = {BEGUN: begun.to_bytes(), **({STATE: state} if state else {})}
    return Unit("run", WORK, order_of(command, run), files, seconds)


@pytest.fixture
def command(tmp_path):
    return sent_command(tmp_path)


@pytest.fixture(params=["left off", "taken up"])
def continued(request, monkeypatch):
    """Let a worker keep the run that it left off, or not, as another worker would."""
    if request.param == "taken up":
        monkeypatch.setattr(
            portions, "_left_off", type("Forgetful", (dict,), {"__setitem__": lambda *_: None})()
        )


def test_portion_after_portion_a_run_is_what_it_is_in_one(command, continued):
    whole = advance(unit_of(command, seconds=None))
    assert whole.finished
    texts, state, begun, count = b"", None, START, 0
    while True:
        part = advance(unit_of(command, state, begun))
        texts += part.files.get(METRICS, b"")
        state, count = part.files[STATE], count + 1
        begun = Begun(texts.count(b"\n"), [METRICS], None)
        if part.finished:
            break
    assert count == 5
    assert texts == whole.files[METRICS]
    assert command.restored(0, checkpoint.unpacked(state, command.who, "it")).answer is not None


def test_a_portion_has_a_step_at_least_and_ends_with_the_first_after_its_time(command):
    part = advance(unit_of(command))
    assert not part.finished
    assert [json.loads(line)["generation"] for line in part.files[METRICS].splitlines()] == [1]


def test_a_worker_that_is_to_stop_gives_back_what_it_has(command):
    unit = unit_of(command, seconds=None)
    with stop_request_of_context() as request:
        steps = type(command).steps

        def stopping(self, reached, deadline):
            for number, step in enumerate(steps(self, reached, deadline)):
                yield step
                if number == 1:
                    request.make()

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(type(command), "steps", stopping)
            part = advance(unit)
        assert not part.finished
        assert part.files[METRICS].count(b"\n") == 2
        nothing = advance(unit_of(command, part.files[STATE], Begun(2, [METRICS], None)))
        assert (nothing.files, nothing.finished) == ({}, False)
    assert request is not None
    rest = advance(unit_of(command, part.files[STATE], Begun(2, [METRICS], None), seconds=None))
    whole = advance(unit_of(command, seconds=None))
    assert part.files[METRICS] + rest.files[METRICS] == whole.files[METRICS]


def test_an_order_is_plain_data_in_which_no_file_is_needed(command, tmp_path):
    order = order_of(command, 1)
    assert json.loads(json.dumps(order)) == order
    assert order["problem"]["text"] == SENT
    assert str(tmp_path) not in json.dumps(order)


def test_a_command_of_unknown_origin_has_no_order(tmp_path):
    with pytest.raises(ValueError, match="not known what"):
        order_of(command_of(tmp_path), 0)


def test_another_spec_than_the_one_sent_is_refused(command):
    order = order_of(command, 0)
    order["problem"]["overrides"] = ["environment.steps=3"]
    with pytest.raises(RuntimeError, match="not the one that was sent"):
        prepare(Unit("run", PREPARE, order))


@pytest.mark.parametrize("rival", ["hill", "paper"])
def test_a_rival_is_the_same_elsewhere(tmp_path, rival):
    loaded = load(Source("guess.yaml", SENT), seed=11, overrides=["design.method=random"])
    command = rival_command(sent_command(tmp_path, budgets=(5000,)), rival, loaded)
    part = advance(unit_of(command, seconds=0.0))
    reached = command.restored(0, checkpoint.unpacked(part.files[STATE], command.who, "it"))
    expected, line = next(command.steps(command.fresh(0)))
    assert part.files.get(METRICS, b"") == (line_text(line) if line else b"")
    assert part.files[STATE] == checkpoint.packed(command.who, run_arrays(expected))
    assert run_arrays(reached).keys() == run_arrays(expected).keys()
