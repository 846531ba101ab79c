"""`bbsd watch` beside a design that goes on."""

import os
import shutil
import signal
import time
from pathlib import Path
from socket import socket
from urllib.request import urlopen

import pytest

from tests.end_to_end.commands import bbsd, process
from tests.unit.report.watching.event_reader import scalars

SPEC = Path(__file__).parent / "specs" / "thermostat.yaml"


def content_of(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.slow
def test_a_run_is_watched_to_its_end_and_is_the_same(tmp_path):
    bbsd("design", SPEC, "--out", tmp_path / "alone")
    folder = tmp_path / "watched"
    folder.mkdir()
    with (
        process("watch", folder, "--tensorboard", tmp_path / "events") as watching,
        process("design", SPEC, "--out", folder, "-q") as designing,
    ):
        out, err = watching.communicate(timeout=120)
        designing.communicate(timeout=120)
    assert (watching.returncode, err) == (0, "")
    assert out.splitlines()[-1].startswith(f"{folder} is done: mean return ")
    for name in ("architecture.yaml", "metrics.jsonl"):
        assert (folder / name).read_bytes() == (tmp_path / "alone" / name).read_bytes()
    (path,) = (tmp_path / "events").rglob("*tfevents*")
    metrics = (folder / "metrics.jsonl").read_text().count("\n")
    assert len(scalars(path.read_bytes())[1]["mean"]) == metrics


@pytest.mark.slow
def test_a_run_that_is_done_is_shown_at_once_from_a_folder_that_cannot_be_written(tmp_path):
    folder = tmp_path / "run"
    bbsd("design", SPEC, "--out", folder)
    before = content_of(folder)
    folder.chmod(0o555)
    code, out, err = bbsd("watch", folder)
    folder.chmod(0o755)
    assert (code, err) == (0, "")
    assert "is done: mean return" in out
    assert content_of(folder) == before


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_ctrl_c_ends_it_without_a_word(tmp_path):
    with process("watch", tmp_path) as watching:
        assert watching.stdout.readline().endswith("has not begun\n")
        time.sleep(0.2)
        watching.send_signal(signal.SIGINT)
        out, err = watching.communicate(timeout=30)
    assert (watching.returncode, out, err) == (130, "", "")


def test_a_run_that_was_stopped_ends_it_and_can_be_continued(tmp_path):
    (tmp_path / "run.json").write_text('{"runs": 1, "seed": 4, "budgets": [600]}')
    (tmp_path / "spec.yaml").write_text(SPEC.read_text())
    code, out, err = bbsd("watch", tmp_path)
    assert (code, out) == (0, f"{tmp_path} was stopped\n")
    assert "--resume --out" in err
    assert "--seed 4" in err


def test_another_folder_is_refused(tmp_path):
    shutil.copy(SPEC, tmp_path / "other.yaml")
    code, out, err = bbsd("watch", tmp_path)
    assert (code, out) == (2, "")
    assert "is no folder of a run" in err
    assert bbsd("watch", tmp_path / "none")[0] == 2


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_the_page_of_a_run_is_served_until_ctrl_c(tmp_path):
    folder = tmp_path / "run"
    bbsd("design", SPEC, "--out", folder)
    before = content_of(folder)
    with process("watch", folder, "--serve") as watching:
        address = watching.stderr.readline().split()[0]
        said = [watching.stderr.readline() for _ in range(2)]
        with urlopen(address) as response:
            page = response.read().decode()
        watching.send_signal(signal.SIGINT)
        watching.communicate(timeout=30)
    assert said[1] == "the page is there\n"
    assert watching.returncode == 130
    assert address.startswith("http://127.0.0.1:")
    assert "data-watched" not in page
    assert "<!DOCTYPE html>" in page or "<!doctype html>" in page
    assert content_of(folder) == before


def test_a_port_that_is_taken_is_a_mistake_of_the_user(tmp_path):
    with socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        code, _, err = bbsd("watch", tmp_path, "--serve", "--port", taken.getsockname()[1])
    assert code == 2
    assert "in use" in err
