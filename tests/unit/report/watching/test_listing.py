import json
from math import nan
from pathlib import Path

import pytest

from bbsd.report.plain import json_text
from bbsd.report.watching.listing import listing_plain, listing_text
from bbsd.runs.storage.listing import Listed

VALUES = {
    "detail": "",
    "version": "",
    "method": "auto",
    "seed": 3,
    "runs": 1,
    "done": 4100,
    "budget": 60_000,
    "has_generations": False,
    "mean": nan,
    "low": nan,
    "high": nan,
    "best": 301.25,
    "written": 1.8e9,
}
STOPPED = {**VALUES, "folder": Path("runs/a"), "state": "stopped"}
FINISHED = {
    **VALUES,
    "folder": Path("runs/b"),
    "state": "finished",
    "mean": 307.5,
    "low": 307.0,
    "high": 308.0,
}


@pytest.fixture(autouse=True)
def somewhere(monkeypatch):
    import time

    monkeypatch.setattr(time, "localtime", time.gmtime)


def test_each_run_is_a_line():
    assert listing_text([Listed(**STOPPED), Listed(**FINISHED)]) == (
        "run     state     method  seed                      done    mean return  last written\n"
        "runs/a  stopped   auto       3  4,100 of 60,000 episodes  301.25 so far  2027-01-15 08:00\n"
        "runs/b  finished  auto       3            4,100 episodes         307.50  2027-01-15 08:00"
    )


def test_what_else_there_is_to_say_stands_below():
    found = Listed(**{**STOPPED, "version": "bbsd 0.1.0, revision 2", "detail": "odd \x1b"})
    assert listing_text([found]).splitlines()[2] == "    odd \\x1b; by bbsd 0.1.0, revision 2"


def test_runs_of_generations():
    found = Listed(
        **{**STOPPED, "method": "paper", "runs": 3, "done": 7, "budget": 150, "has_generations": True}
    )
    (plain,) = listing_plain([found])
    assert "paper, 3 runs" in listing_text([found])
    assert "7 of 150 generations" in listing_text([found])
    assert (plain["generations"], plain["budget"], "episodes" in plain) == (7, 150, False)


def test_what_is_not_known_is_empty_or_null():
    unknown = {"method": "", "seed": None, "done": 0, "budget": 0, "best": nan, "written": 0.0}
    found = Listed(**{**STOPPED, **unknown, "state": "not begun"})
    assert listing_text([found]).splitlines()[1] == "runs/a  not begun"
    (plain,) = json.loads(json_text(listing_plain([found])))
    assert [key for key, value in plain.items() if value is None] == [
        "other_version",
        "method",
        "seed",
        "budget",
        "return",
        "best_so_far",
        "written",
    ]


def test_the_same_for_programs():
    (plain,) = listing_plain([Listed(**FINISHED)])
    assert plain["return"] == {"mean": 307.5, "ci95": [307.0, 308.0]}
    assert plain["written"] == "2027-01-15T08:00:00Z"


def test_nothing_is_no_line():
    assert listing_text([]) == ""
