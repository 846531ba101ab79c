import json
from functools import partial

import pytest

from bbsd.runs.run import generations, start
from bbsd.runs.storage import checkpoint
from bbsd.runs.storage import records as module
from bbsd.runs.storage.records import FolderError, Journal, Records
from bbsd.runs.storage.state import restored_run, run_arrays
from tests.unit.runs.commands import WHO
from tests.unit.solver.problems import guess

SEED = 3


@pytest.fixture
def records(tmp_path):
    return Records(tmp_path / "run")


@pytest.fixture(scope="module")
def lived():
    """All that the generations of a run yield."""
    problem, settings = guess()
    return list(generations(start(problem, settings, SEED, 1), problem, settings, SEED))


def read(arrays):
    problem, settings = guess()
    return restored_run(arrays, start(problem, settings, SEED, 1), problem)


def load(records):
    return records.load(WHO, read)


def save(records, steps, interval=0.0):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "INTERVAL", interval)
        with Journal(records, WHO) as journal:
            for progress, line in steps:
                journal.add(partial(run_arrays, progress), line)


def lines_of(records):
    return [(line["run"], line["generation"]) for line in records.lines()]


def test_what_is_saved_is_resumed(records, lived):
    assert load(records) is None
    save(records, lived[:2])
    found = load(records)
    assert (found.run, found.state.generation, found.answer) == (1, 2, None)
    assert lines_of(records) == [(2, 1), (2, 2)]


def test_an_answer_is_kept_with_the_state(records, lived):
    save(records, lived)
    assert load(records).answer.structure.tolist() == lived[-1][0].answer.structure.tolist()
    assert lines_of(records) == [(2, 1), (2, 2), (2, 3), (2, 4)]


def test_a_state_is_saved_at_most_once_in_an_interval_and_when_the_run_stops(records, lived):
    saved = []

    def steps():
        for step in lived[:3]:
            yield step
            saved.append(checkpoint.load(records.checkpoint, WHO)["state.generation"])
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        save(records, steps(), interval=60)
    assert saved == [1, 1, 1]
    assert load(records).state.generation == 3
    assert lines_of(records) == [(2, 1), (2, 2), (2, 3)]


def test_metrics_are_cut_back_to_the_state(records, lived):
    save(records, lived[:3])
    before = records.metrics.read_bytes()
    with records.metrics.open("a") as file:  # as if killed between the two
        file.write(json.dumps(lived[3][1]) + "\n" + '{"run": 1, "gener')
    load(records)
    assert records.metrics.read_bytes() == before


def test_metrics_without_a_state_are_begun_anew(records):
    records.path.mkdir()
    records.metrics.write_text('{"run": 1, "generation": 1}\n')
    assert load(records) is None
    assert records.lines() == []


def test_damaged_metrics_are_an_error_that_says_what_to_do(records):
    records.path.mkdir()
    records.metrics.write_text("no line\n")
    with pytest.raises(FolderError, match=r"is damaged.*remove the folder to start again"):
        records.lines()


@pytest.mark.parametrize(
    "damage", [lambda content: content[:-3], lambda _: b"", lambda content: content + b"x"]
)
def test_a_damaged_checkpoint_costs_what_was_done_since_the_one_before(records, lived, damage):
    save(records, lived[:3])
    records.checkpoint.write_bytes(damage(records.checkpoint.read_bytes()))
    assert load(records).state.generation == 2
    assert lines_of(records) == [(2, 1), (2, 2)]


def test_a_run_whose_newest_checkpoint_was_never_written_has_the_one_before(records, lived):
    save(records, lived[:2])
    records.checkpoint.unlink()  # as if killed between the two files
    assert load(records).state.generation == 1


def test_two_damaged_checkpoints_are_an_error_that_says_what_to_do(records, lived):
    save(records, lived[:2])
    for path in (records.checkpoint, records.previous):
        path.write_bytes(path.read_bytes()[:-3])
    with pytest.raises(
        FolderError, match=r"is damaged.*previous.* is damaged.*remove the folder to start again"
    ):
        load(records)


@pytest.mark.parametrize("content", [b"", b'{"run": 9}\n'])
def test_metrics_that_lost_lines_are_never_a_silent_gap(records, lived, content):
    save(records, lived[:2])
    records.metrics.write_bytes(content)
    with pytest.raises(FolderError, match=r"metrics.jsonl is not what it was when"):
        load(records)


def test_metrics_that_lost_the_last_line_go_with_the_state_before(records, lived):
    save(records, lived[:3])
    content = records.metrics.read_bytes().splitlines(keepends=True)
    records.metrics.write_bytes(b"".join(content[:2]))
    assert load(records).state.generation == 2


def test_a_step_that_was_written_in_part_is_saved_with_no_state(records, lived, monkeypatch):
    """The state from before it would stand beside files that are ahead, and the step would be there twice."""
    monkeypatch.setattr(module, "INTERVAL", 1e9)
    with pytest.raises(OSError, match="full"):
        write_in_part(records, lived)
    assert load(records).state.generation == 1
    assert lines_of(records) == [(2, 1)]


def write_in_part(records, lived):
    """Write the metrics of the third step, and then meet a full disk; only the first state is saved."""
    with Journal(records, WHO) as journal:
        journal._saved_at = -1e10
        for progress, line in lived[:2]:
            journal.add(partial(run_arrays, progress), line)
        progress, line = lived[2]
        journal.add(partial(run_arrays, progress), line, broken())


def broken():
    raise OSError("the disk is full")
    yield


def test_a_damaged_state_is_never_put_in_the_place_of_a_good_one(records, lived):
    save(records, lived[:2])
    records.checkpoint.write_bytes(b"damaged")
    assert load(records).state.generation == 1
    assert not records.checkpoint.exists()
    save(records, lived[1:2])
    records.checkpoint.unlink()
    assert load(records).state.generation == 1
