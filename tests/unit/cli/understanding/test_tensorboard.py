import pytest

from tests.unit.cli.commands import run
from tests.unit.report.watching.event_reader import scalars

SPEC = """
bbsd: 1
name: small
environment: {steps: 2, state: {x: 0}}
behaviors:
  go: {actions: {a: {x: x + 1}, b: {x: x - 1}}}
reward: {right: x}
"""


@pytest.mark.slow
def test_a_design_writes_event_files_of_its_metrics(tmp_path, capsys):
    (tmp_path / "spec.yaml").write_text(SPEC)
    words = ("--budget", 5000, "-q", "--tensorboard", tmp_path / "events")
    assert run("design", tmp_path / "spec.yaml", "--out", tmp_path / "run", *words) == 0
    (path,) = (tmp_path / "events").rglob("*tfevents*")
    _, found = scalars(path.read_bytes())
    assert found["mean"][-1][1] == 3.0
    assert run("design", tmp_path / "spec.yaml", "--seeds", "0-1", "--out", tmp_path / "runs", *words) == 0
    assert {path.relative_to(tmp_path / "events").parts[0] for path in tmp_path.rglob("*tfevents*")} == {
        "run-1",
        "seed-0",
        "seed-1",
    }


def test_a_folder_that_cannot_be_made_is_told_before_the_design(tmp_path, capsys):
    (tmp_path / "spec.yaml").write_text(SPEC)
    (tmp_path / "file").touch()
    words = ("--out", tmp_path / "run", "--tensorboard", tmp_path / "file")
    assert run("design", tmp_path / "spec.yaml", *words) == 2
    assert not (tmp_path / "run").exists()
    assert "file" in capsys.readouterr().err
