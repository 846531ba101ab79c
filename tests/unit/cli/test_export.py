import pytest

from bbsd.exports.verification import compilers
from bbsd.exports.verification.tools import ToolMissing
from tests.end_to_end.commands import bbsd
from tests.unit.architecture.designs import SPECS
from tests.unit.exports.designs import library, tool

DESIGN = SPECS / "object_lifting_hand.yaml"


def test_a_design_is_printed_in_another_language():
    code, out, err = bbsd("export", DESIGN, "--to", "python")
    assert (code, err) == (0, "")
    names = {}
    exec(out, names)
    assert names["command"](0, 1, 0, 0) == 3


def test_it_is_written_to_a_file_and_verified_there(tmp_path):
    tool("gcc")
    code, out, err = bbsd("export", DESIGN, "--to", "c", "-o", tmp_path / "lift.h", "--verify")
    assert (code, out) == (0, "")
    assert err == f"wrote {tmp_path / 'lift.h'}\ngcc: 72 of 72 cells equal\n"
    assert (tmp_path / "lift.h").read_text().startswith("/* object-lifting-by-hand\n")


def test_a_missing_tool_is_told_and_is_a_failure(monkeypatch):
    def missing(_):
        raise ToolMissing("gcc")

    monkeypatch.setattr(compilers, "found", missing)
    code, out, err = bbsd("export", DESIGN, "--to", "c", "--verify")
    assert code == 1
    assert out.startswith("/* object-lifting-by-hand")
    assert err == "gcc was not found: not verified\n"


def test_a_compiler_that_fails_is_a_failure(monkeypatch):
    tool("gcc")
    monkeypatch.setattr(compilers, "STRICT", ("-not-an-option",))
    code, _, err = bbsd("export", DESIGN, "--to", "c", "--verify")
    assert code == 1
    assert err.startswith("gcc: not verified: gcc failed with code 1: ")


def test_another_answer_is_shown_with_its_cells(monkeypatch):
    def wrong(files, cells, *_):
        return cells[:, 0] * 0 + 1

    monkeypatch.setattr(compilers, "compiled_answers", wrong)
    code, _, err = bbsd("export", DESIGN, "--to", "c", "--verify")
    assert code == 1
    assert err == (
        "gcc: 20 of 72 cells equal\n"
        "  where pace 0, reached false, place lowest, tilted true: the design decides faster of hurry_up,"
        " gcc push of push_more\n"
    )


def test_a_design_with_holes_is_refused_in_words(tmp_path):
    code, out, err = bbsd("export", SPECS / "object_lifting.yaml", "--to", "c", "-o", tmp_path / "x.h")
    assert (code, out) == (2, "")
    assert "the design has holes" in err
    assert not (tmp_path / "x.h").exists()


@pytest.mark.parametrize("words", [["--to", "rust"], []])
def test_a_target_must_be_one(words):
    code, _, err = bbsd("export", DESIGN, *words)
    assert code == 2
    assert "--to" in err


def test_a_tree_is_written_and_run_by_its_library(tmp_path):
    library("behaviortreepy")
    words = ("--to", "btcpp", "--leaves", "custom", "-o", tmp_path / "lift.xml", "--verify")
    code, _, err = bbsd("export", DESIGN, *words)
    assert code == 0
    assert "behaviortreepy: 72 of 72 cells equal" in err
    assert "<TreeNodesModel>" in (tmp_path / "lift.xml").read_text()


def test_what_nothing_runs_is_not_verified():
    code, out, err = bbsd("export", DESIGN, "--to", "ros2", "--verify")
    assert code == 1
    assert "nothing here runs ros2: not verified" in err
    assert "import rclpy" in out


def test_custom_leaves_are_those_of_one_target():
    code, out, err = bbsd("export", DESIGN, "--to", "c", "--leaves", "custom")
    assert (code, out) == (2, "")
    assert "c has no custom leaves" in err
