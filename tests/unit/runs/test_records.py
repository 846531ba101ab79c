import json

import pytest

from bbsd.runs.records import FolderError, Records
from bbsd.runs.run import generations, start
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


def lines_of(records):
    return [(line["run"], line["generation"]) for line in records.lines()]


def test_what_is_saved_is_resumed(records, lived):
    assert records.load() is None
    for progress, line in lived[:2]:
        records.save(progress, line)
    found = records.load()
    assert (found.run, found.state.generation, found.answer) == (1, 2, None)
    assert lines_of(records) == [(2, 1), (2, 2)]


def test_an_answer_is_kept_without_a_line(records, lived):
    for progress, line in lived:
        records.save(progress, line)
    assert records.load().answer.structure.tolist() == lived[-1][0].answer.structure.tolist()
    assert lines_of(records) == [(2, 1), (2, 2), (2, 3), (2, 4)]


def test_metrics_are_cut_back_to_the_state(records, lived):
    for progress, line in lived[:3]:
        records.save(progress, line)
    before = records.metrics.read_bytes()
    with records.metrics.open("a") as file:  # as if killed between the two
        file.write(json.dumps(lived[3][1]) + "\n" + '{"run": 1, "gener')
    records.load()
    assert records.metrics.read_bytes() == before


def test_metrics_without_a_state_are_begun_anew(records):
    records.path.mkdir()
    records.metrics.write_text('{"run": 1, "generation": 1}\n')
    assert records.load() is None
    assert records.lines() == []


def test_damaged_metrics_are_an_error_that_says_what_to_do(records):
    records.path.mkdir()
    records.metrics.write_text("no line\n")
    with pytest.raises(FolderError, match=r"is damaged.*remove the folder to start again"):
        records.lines()


def test_a_damaged_checkpoint_is_an_error_that_says_what_to_do(records, lived):
    records.save(*lived[0])
    path = records.path / "checkpoint.npz"
    path.write_bytes(path.read_bytes()[:-3])
    with pytest.raises(FolderError, match=r"is damaged.*remove the folder to start again"):
        records.load()
