import json

import numpy as np
import pytest

from bbsd.architecture.visits import Visits
from bbsd.runs.storage.finished import VISITS as FILE
from bbsd.runs.storage.visits import read_visits, write_visits

VISITS = Visits(
    3,
    120,
    (np.array([0, 70, 2]), np.array([40])),
    (np.array([0, 70, 0]), np.array([40])),
)
NAMES, TEXT = ('stop: at "goal"', "push"), "bbsd: 1\n"
CELLS = dict(zip(NAMES, (3, 1), strict=True))


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "architecture.yaml").write_text(TEXT)
    write_visits(tmp_path, TEXT, NAMES, VISITS)
    return tmp_path


def test_what_was_written_is_read(folder):
    found = read_visits(folder, CELLS)
    assert (found.episodes, found.robot_steps) == (3, 120)
    assert [cells.tolist() for cells in found.asked] == [[0, 70, 2], [40]]
    assert [cells.tolist() for cells in found.controlled] == [[0, 70, 0], [40]]
    assert (found.nobody, found.share(1)) == (10, 40 / 120)


def test_the_file_is_small_and_plain(folder):
    text = (folder / FILE).read_text()
    assert json.loads(text)["behaviors"][NAMES[0]] == {"cells": 3, "asked": {"1": [70, 70], "2": [2, 0]}}
    before = text
    write_visits(folder, TEXT, NAMES, VISITS)
    assert (folder / FILE).read_text() == before


def test_visits_of_another_design_do_not_count(folder):
    (folder / "architecture.yaml").write_text("bbsd: 1 # edited\n")
    assert read_visits(folder, CELLS) is None


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"format": 1}'])
def test_a_damaged_file_is_as_none(folder, text):
    (folder / FILE).write_text(text)
    assert read_visits(folder, CELLS) is None


def test_a_folder_without_visits_has_none(tmp_path):
    assert read_visits(tmp_path, CELLS) is None


@pytest.mark.parametrize(
    "changed",
    [
        {"cells": 10**12},
        {"cells": 2},
        {"asked": []},
        {"asked": {"-1": [1, 1]}},
        {"asked": {"7": [1, 1]}},
        {"asked": {"1": [10**400, 1]}},
        {"asked": {"1": [-1, 1]}},
        {"asked": {"1": 3}},
    ],
    ids=str,
)
def test_counts_that_a_behavior_cannot_have_are_as_none(folder, changed):
    content = json.loads((folder / FILE).read_text())
    content["behaviors"][NAMES[0]] |= changed
    (folder / FILE).write_text(json.dumps(content))
    assert read_visits(folder, CELLS) is None
