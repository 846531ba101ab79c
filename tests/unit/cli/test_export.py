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


def test_a_header_with_sensing_is_run_beside_the_design(tmp_path):
    tool("gcc")
    words = ("--to", "c", "--sensing", "--episodes", 1, "-o", tmp_path / "lift.h", "--verify")
    code, out, err = bbsd("export", DESIGN, *words)
    assert (code, out) == (0, "")
    _, cells, sensing = err.splitlines()
    assert cells == "gcc: 72 of 72 cells equal"
    assert sensing.startswith("gcc with sensing: 900 of 900 steps of 1 recorded episode and ")
    assert sensing.endswith(" situations at edges of cells and elsewhere equal (tested, not proven)")
    assert "static inline double bbsd_atan(double x)" in (tmp_path / "lift.h").read_text()


def test_what_the_robot_measures_is_an_input_of_the_header():
    code, out, _ = bbsd("export", DESIGN, "--to", "c", "--sensing", "--measured", "tilt")
    assert code == 0
    assert "    double tilt; /*" in out or "    double tilt;" in out
    assert "bbsd_atan" not in out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--to", "python", "--sensing"), "python has no sensors"),
        (("--to", "c", "--measured", "tilt"), "only where sensors are written"),
        (("--to", "c", "--sensing", "--measured", "tlt"), 'did you mean "tilt"?'),
        (("--to", "c", "--sensing", "--remembered", "height"), "cannot remember height"),
    ],
)
def test_what_cannot_be_sensed_is_refused_in_words(words, message):
    code, out, err = bbsd("export", DESIGN, *words)
    assert (code, out) == (2, "")
    assert message in err
