"""Names that are words of the language elsewhere, or of the languages that a design is written in."""

from pathlib import Path

import pytest

import bbsd
from bbsd.architecture import holes_of
from bbsd.compiler import compile_meaning
from bbsd.report.csv_text import csv_text
from tests.end_to_end.test_against_interpreter import compared
from tests.unit.exports.designs import require

WORDS = Path(__file__).parent / "specs" / "words.yaml"


@pytest.fixture(scope="module")
def design(tmp_path_factory):
    folder = tmp_path_factory.mktemp("words") / "run"
    bbsd.design(WORDS, out=folder)
    return folder / "architecture.yaml"


@pytest.mark.parametrize("compiled", [False, True])
def test_kernels_mean_what_the_interpreter_reads(compiled):
    meaning = bbsd.load(WORDS, seed=5).meaning
    compared(compile_meaning(meaning, compiled=compiled), seed=5, generation=1, n_agents=2, agents_seed=1)


def test_what_is_designed_has_no_holes_and_columns_of_its_own(design):
    assert not holes_of(bbsd.load(design).meaning)
    head = csv_text(bbsd.trace(design)).splitlines()[0].split(",")
    assert len(set(head)) == len(head)
    assert {"action_0", "action__0", "reward_step_0", "cell_step_0"} <= set(head)


@pytest.mark.parametrize("target", ["c", "python", "btcpp", "pytrees"])
def test_exports_are_equal_in_all_cells(design, target):
    for verified in bbsd.export(design, target, verify=True, sensing=target == "c").verified:
        require(verified)
        assert verified.is_equal, verified
