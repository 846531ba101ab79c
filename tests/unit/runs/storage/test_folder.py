import json
import os
from dataclasses import replace
from pathlib import Path

import pytest

from bbsd.runs.storage.choosing import folder_to_resume, new_folder
from bbsd.runs.storage.folder import DIGEST, Folder, FolderError, digest_of
from bbsd.runs.storage.identity import Identity
from bbsd.version import REVISION, __version__

WHO = Identity((("environment", "a"), ("reward", "b")), 3, 2)
LINE = {
    "run": 1, "generation": 1, "mean": 0.5, "best": 1.0, "sd": 0.1, "lifetime": 0.4, "diversity": {},
    "structure": ["push"],
}  # fmt: skip
OTHER = replace(WHO, spec=(("environment", "a"), ("reward", "c")))


@pytest.fixture
def folder(tmp_path):
    return Folder(tmp_path)


def test_the_only_run_is_kept_in_the_folder_itself(folder):
    assert folder.records(0, 1).path == folder.path
    assert folder.records(2, 4).path == folder.path / "run-3"


def test_the_metrics_of_all_runs_are_gathered_in_their_order(folder):
    for run in (1, 0, 2):
        records = folder.records(run, 3)
        records.path.mkdir()
        records.metrics.write_text(json.dumps(LINE | {"run": run + 1}) + "\n")
    folder.gather(3)
    assert [line["run"] for line in folder.lines()] == [1, 2, 3]


def test_the_metrics_of_the_only_run_are_left_as_they_are(folder):
    folder.metrics.write_text(json.dumps(LINE) + "\n")
    folder.gather(1)
    assert folder.lines() == [LINE]


def test_a_run_file_says_what_was_run_and_with_what(folder):
    folder.write_run_file(WHO, ["design.sharing=value"], [300, 200])
    note = json.loads(folder.run_file.read_text())
    assert (note["format"], note["seed"], note["runs"], note["set"]) == (3, 3, 2, ["design.sharing=value"])
    assert (note["bbsd"], note["revision"]) == (__version__, REVISION)
    assert note["spec"] == {"environment": "a", "reward": "b"}
    assert folder.budgets() == (300, 200)
    assert "numba" in note["versions"]
    assert "result" not in note
    folder.write_run_file(WHO, result={"return": 5})
    assert folder.result() == {"return": 5}


def test_a_folder_holds_only_an_equal_identity(folder):
    folder.write_run_file(WHO)
    assert folder.holds(WHO)
    others = [
        OTHER,
        replace(WHO, seed=4),
        replace(WHO, runs=1),
    ]
    assert not any(folder.holds(other) for other in others)


@pytest.mark.parametrize("text", ["", "[]", "{}", "no note"])
def test_what_is_no_run_file_identifies_nothing(folder, text):
    folder.run_file.write_text(text)
    assert not folder.holds(WHO)


def test_new_folders_are_the_first_free_ones(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    made = [new_folder(None, "lift", 7).path for _ in range(3)]
    assert made == [Path("runs/lift-seed7"), Path("runs/lift-seed7-2"), Path("runs/lift-seed7-3")]
    assert all(path.is_dir() for path in made)


def test_a_file_in_the_way_is_passed_over(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("runs").mkdir()
    Path("runs/lift-seed7").touch()
    Path("runs/lift-seed7-2").symlink_to("nowhere")
    assert new_folder(None, "lift", 7).path == Path("runs/lift-seed7-3")


def test_a_wanted_folder_may_be_new_or_empty(tmp_path):
    wanted = tmp_path / "some" / "where"
    assert new_folder(wanted, "lift", 7).path == wanted
    assert new_folder(wanted, "lift", 7).path == wanted


def test_nothing_is_overwritten(tmp_path):
    (tmp_path / "mine").touch()
    for wanted in (tmp_path, tmp_path / "mine"):
        with pytest.raises(FolderError, match="is not empty; nothing is overwritten"):
            new_folder(wanted, "lift", 7)


def test_a_folder_that_cannot_be_made_is_an_error(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(FolderError, match="cannot be made"):
        new_folder(tmp_path / "file" / "below", "lift", 7)


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="nothing is forbidden here")
def test_a_folder_that_cannot_be_read_is_an_error(tmp_path):
    tmp_path.chmod(0)
    with pytest.raises(FolderError, match="cannot be made"):
        new_folder(tmp_path, "lift", 7)
    tmp_path.chmod(0o700)


def test_the_newest_default_folder_of_an_equal_identity_is_resumed(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for who in (WHO, WHO, OTHER):
        new_folder(None, "lift", 3).write_run_file(who)
    assert folder_to_resume(None, "lift", WHO).path == Path("runs/lift-seed3-2")
    assert folder_to_resume(None, "lift", OTHER).path == Path("runs/lift-seed3-3")
    with pytest.raises(FolderError, match="there is no run"):
        folder_to_resume(None, "push", WHO)


def test_a_wanted_folder_must_have_an_equal_identity(tmp_path):
    with pytest.raises(FolderError, match="holds no run of this spec"):
        folder_to_resume(tmp_path, "lift", WHO)
    Folder(tmp_path).write_run_file(WHO)
    assert folder_to_resume(tmp_path, "lift", WHO).path == tmp_path


def test_what_differs_in_a_wanted_folder_is_named(folder):
    folder.write_run_file(WHO)
    with pytest.raises(FolderError, match="different are the spec's reward and the seed \\(3, not 4\\)"):
        folder_to_resume(folder.path, "lift", replace(OTHER, seed=4))


def test_a_designed_spec_that_was_edited_is_kept(folder):
    folder.write_architecture("one\n")
    folder.write_run_file(WHO, result={DIGEST: digest_of("one\n")})
    folder.architecture.write_text("mine\n")
    folder.write_architecture("one\n")
    assert folder.architecture.read_text() == "mine\n"
    folder.write_architecture("two\n")  # after a further budget
    assert folder.architecture.read_text() == "two\n"
    assert (folder.path / "architecture.edited.yaml").read_text() == "mine\n"


def test_a_designed_spec_that_was_cut_short_is_written_again(folder):
    folder.write_run_file(WHO, result={DIGEST: digest_of("one\n")})
    folder.architecture.touch()
    folder.write_architecture("one\n")
    assert folder.architecture.read_text() == "one\n"


def test_a_designed_spec_that_was_cut_in_the_middle_is_written_again(folder):
    folder.write_run_file(WHO, result={DIGEST: digest_of("one and more\n")})
    folder.architecture.write_text("one a")
    folder.write_architecture("one and more\n")
    assert folder.architecture.read_text() == "one and more\n"


def test_a_designed_spec_that_is_ahead_of_the_record_is_left_in_its_place(folder):
    """A kill between the two files, after a further budget."""
    folder.write_run_file(WHO, result={DIGEST: digest_of("one\n")})
    folder.architecture.write_text("two\n")
    folder.write_architecture("two\n")
    assert folder.architecture.read_text() == "two\n"
    assert not (folder.path / "architecture.edited.yaml").exists()


def test_a_folder_below_that_is_a_link_is_refused(folder, tmp_path_factory):
    (folder.path / "run-1").symlink_to(tmp_path_factory.mktemp("outside"))
    with pytest.raises(FolderError, match="run-1 is a link"):
        folder.records(0, 2)
    with pytest.raises(FolderError, match="remove it to go on"):
        folder.below("run-1")


def test_a_design_begins_only_where_no_other_one_is(folder):
    folder.path.joinpath("lock").touch()
    folder.write_run_file(OTHER, budgets=[7])  # of one that failed at once
    folder.begin("bbsd: 1\n")
    assert folder.budgets() == ()
    assert (folder.path / "spec.yaml").read_text() == "bbsd: 1\n"
    (folder.path / "checkpoint.npz").touch()
    with pytest.raises(FolderError, match="is not empty"):
        folder.begin("bbsd: 2\n")
    assert (folder.path / "spec.yaml").read_text() == "bbsd: 1\n"


def test_a_folder_that_is_not_there_is_told(tmp_path):
    with pytest.raises(FolderError, match=r"there is no folder .*start it without --resume"):
        folder_to_resume(tmp_path / "none", "lift", WHO)


def test_a_folder_of_an_older_format_is_told_from_another_run(folder):
    folder.write_run_file(WHO)
    rewrite(folder, spec=None, spec_sha256="a" * 64, revision=REVISION - 1)
    with pytest.raises(FolderError, match="is a run of the same spec and seed by"):
        folder_to_resume(folder.path, "lift", WHO)


@pytest.mark.parametrize("budgets", [3, ["a"], [-1], [True], {"a": 1}], ids=str)
def test_budgets_that_are_none_are_an_error_that_says_what_to_do(folder, budgets):
    folder.write_run_file(WHO)
    rewrite(folder, budgets=budgets)
    with pytest.raises(FolderError, match=r"budgets in .* are damaged; remove the folder"):
        folder.budgets()


def rewrite(folder, **changed):
    """Write other things into a folder's `run.json`; None removes them."""
    content = json.loads(folder.run_file.read_text()) | changed
    folder.run_file.write_text(
        json.dumps({key: value for key, value in content.items() if value is not None})
    )


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"revision": REVISION - 1}, f"by bbsd {__version__}, revision {REVISION - 1}; this is"),
        ({"revision": REVISION + 1}, f"by bbsd {__version__}, revision {REVISION + 1}; this is"),
        ({"revision": None}, f"by bbsd {__version__}, revision unknown; this is"),
        ({"bbsd": "0.0.7"}, f"by bbsd 0.0.7, revision {REVISION}; this is"),
    ],
    ids=str,
)
def test_what_another_revision_wrote_is_not_resumed(folder, changed, told):
    folder.write_run_file(WHO)
    rewrite(folder, **changed)
    assert not folder.holds(WHO)
    with pytest.raises(FolderError) as error:
        folder_to_resume(folder.path, "lift", WHO)
    assert told in str(error.value)
    assert f"this is bbsd {__version__}, revision {REVISION}" in str(error.value)
    with pytest.raises(FolderError, match="holds no run of this spec"):  # another seed comes first
        folder_to_resume(folder.path, "lift", replace(WHO, seed=4))


def test_default_folders_of_another_revision_are_passed_over(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    folders = [new_folder(None, "lift", 3) for _ in range(2)]
    for folder in folders:
        folder.write_run_file(WHO)
    rewrite(folders[1], revision=REVISION + 1)
    assert folder_to_resume(None, "lift", WHO) == folders[0]
    rewrite(folders[0], revision=REVISION + 1)
    with pytest.raises(FolderError, match=r"runs/lift-seed3-2 is a run of the same spec and seed by"):
        folder_to_resume(None, "lift", WHO)
