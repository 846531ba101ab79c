from pathlib import Path

import pytest

from bbsd.report.watching.events import FILE, EventFiles, event_file, record
from bbsd.runs.storage.watching import Watched, WatchedRun
from tests.unit.report.watching.event_reader import crc32c, records, scalars

SEARCH = [
    {
        "run": 1,
        "method": "auto",
        "stage": "search",
        "episodes": 200,
        "mean": 1.5,
        "measured": 22,
        "structure": ["a"],
    },
    {
        "run": 1,
        "method": "auto",
        "stage": "answer",
        "episodes": 400,
        "mean": -2.25,
        "measured": 44,
        "structure": ["a"],
    },
]
GENERATION = {
    "run": 2, "generation": 3, "mean": 0.5, "best": 1.0, "sd": 0.25, "lifetime": 0.125,
    "diversity": {"rise": 0.75, "fall": 0.0}, "structure": ["rise"],
}  # fmt: skip


def watched(*runs):
    return Watched(Path("run"), "running", 2, 400, tuple(runs), {})


def run(lines, number=1, rival=""):
    return WatchedRun(number, rival, tuple(lines))


def test_the_reader_knows_the_check():
    assert crc32c(b"123456789") == 0xE3069283  # the check value of CRC-32C


@pytest.mark.parametrize("data", [b"", b"a", bytes(range(256)) * 3])
def test_records_are_read_back(data):
    assert list(records(record(data) + record(b"next"))) == [data, b"next"]


def test_a_search_is_read_back():
    assert scalars(event_file(SEARCH)) == (
        b"brain.Event:2",
        {"mean": [(200, 1.5), (400, -2.25)], "measured": [(200, 22.0), (400, 44.0)]},
    )


def test_a_generation_is_read_back_with_the_diversity_of_each_pool():
    _, found = scalars(event_file([GENERATION]))
    assert found == {
        "mean": [(3, 0.5)],
        "best": [(3, 1.0)],
        "sd": [(3, 0.25)],
        "lifetime": [(3, 0.125)],
        "diversity/rise": [(3, 0.75)],
        "diversity/fall": [(3, 0.0)],
    }


def test_large_steps_are_read_back():
    line = {**SEARCH[0], "episodes": 123_456_789_012}
    assert scalars(event_file([line]))[1]["mean"] == [(123_456_789_012, 1.5)]


def test_files_grow_with_the_runs(tmp_path):
    files = EventFiles(tmp_path / "events")
    files.update(watched(run(SEARCH[:1])))
    path = tmp_path / "events" / "run-1" / FILE
    before = path.stat().st_ino
    files.update(watched(run(SEARCH), run(SEARCH[:1], 2, "hill")))
    assert path.stat().st_ino == before
    assert path.read_bytes() == event_file(SEARCH)
    assert (tmp_path / "events" / "hill-run-2" / FILE).read_bytes() == event_file(SEARCH[:1])


def test_a_file_is_begun_anew_where_a_run_was_taken_back(tmp_path):
    files = EventFiles(tmp_path)
    other = {**SEARCH[1], "mean": 9.0}
    for lines in (SEARCH, SEARCH[:1], [SEARCH[0], other]):
        files.update(watched(run(lines)))
        assert (tmp_path / "run-1" / FILE).read_bytes() == event_file(lines)


def test_the_same_metrics_give_the_same_bytes(tmp_path):
    for name in ("a", "b"):
        EventFiles(tmp_path / name).update(watched(run(SEARCH)))
    assert (tmp_path / "a/run-1" / FILE).read_bytes() == (tmp_path / "b/run-1" / FILE).read_bytes()
