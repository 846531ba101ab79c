import pytest

from bbsd.runs.storage.unused import is_unused, remove_parts


@pytest.fixture
def left(tmp_path):
    """What a design leaves that ended in its first step."""
    for name in ("lock", "spec.yaml", "metrics.jsonl", ".spec.yaml.0a1b2c3d.part"):
        (tmp_path / name).touch()
    (tmp_path / "run.json").write_text('{"seed": 1}')
    (tmp_path / "run-1").mkdir()
    (tmp_path / "run-1" / "metrics.jsonl").touch()
    return tmp_path


def test_what_a_design_leaves_that_achieved_nothing_is_unused(left):
    assert is_unused(left)


@pytest.mark.parametrize(
    "name", ["mine", "architecture.yaml", "run-1/checkpoint.npz", "run-1/mine", "notes.part"]
)
def test_anything_else_is_of_use(left, name):
    (left / name).touch()
    assert not is_unused(left)


def test_a_line_of_metrics_and_a_result_are_of_use(left):
    (left / "run-1" / "metrics.jsonl").write_text("{}\n")
    assert not is_unused(left)
    (left / "run-1" / "metrics.jsonl").write_text("")
    (left / "run.json").write_text('{"result": {"return": 1}}')
    assert not is_unused(left)


def test_a_spec_without_a_lock_is_somebodys_own(tmp_path):
    (tmp_path / "spec.yaml").touch()
    assert not is_unused(tmp_path)


def test_links_are_of_use(left):
    (left / "run-2").symlink_to(left / "run-1")
    assert not is_unused(left)


def test_parts_of_files_are_removed_and_nothing_else(left, tmp_path_factory):
    outside = tmp_path_factory.mktemp("outside") / ".a.00000000.part"
    outside.touch()
    (left / "run-2").symlink_to(outside.parent)
    (left / "run-1" / ".b.00000000.part").touch()
    before = {path for path in left.rglob("*") if not path.name.endswith(".part")}
    remove_parts(left)
    assert {*left.rglob("*")} == before
    assert outside.exists()
