import pytest

from bbsd.cli.understanding.tidy import CAN_BE_SHORTER
from tests.unit.architecture.designs import SPECS
from tests.unit.architecture.test_shorter import WORDY
from tests.unit.cli.commands import run

CHANGES = "lower: 1 word instead of 10\nnever: never controls, and left the structure\nthe same in all 6 situations\n"


@pytest.fixture
def design(tmp_path):
    path = tmp_path / "wordy.yaml"
    path.write_text(WORDY)
    return path


def test_the_shorter_design_is_printed_and_the_file_stays(design, capsys):
    assert run("tidy", design) == 0
    out, err = capsys.readouterr()
    assert "      - otherwise: a\n" in out
    assert err == CHANGES
    assert design.read_text() == WORDY


def test_it_is_written_where_wanted(design, capsys):
    assert run("tidy", design, "-o", design) == 0
    out, err = capsys.readouterr()
    assert (out, err) == ("", f"{CHANGES}wrote {design}\n")
    assert run("tidy", design, "--check") == 0
    assert capsys.readouterr().err == "nothing can be shorter\n"


def test_a_design_that_can_be_shorter_fails_the_check(design, capsys):
    assert run("tidy", design, "--check", "--diff") == CAN_BE_SHORTER
    out, _ = capsys.readouterr()
    assert "-structure: [upper, lower, never]   # in this order\n" in out
    assert "+structure: [upper, lower]   # in this order\n" in out
    assert design.read_text() == WORDY


def test_a_spec_with_holes_is_a_mistake(capsys):
    assert run("tidy", SPECS / "object_lifting.yaml") == 2
    assert "the design has holes" in capsys.readouterr().err


def test_an_output_that_cannot_be_written_is_a_mistake(design, capsys):
    assert run("tidy", design, "-o", design.parent / "no" / "file.yaml") == 2
    assert capsys.readouterr().err.startswith("bbsd: ")
