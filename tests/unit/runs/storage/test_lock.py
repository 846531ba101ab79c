import os
import signal
import subprocess
import sys

import pytest

from bbsd.runs.storage.lock import FolderInUse, only_writer

HOLDER = """
import sys, time
from pathlib import Path
from bbsd.runs.storage.lock import only_writer
with only_writer(Path(sys.argv[1])):
    print("held", flush=True)
    time.sleep(60)
"""

pytestmark = pytest.mark.skipif(os.name == "nt", reason="the system has no such locks")


@pytest.fixture
def holder(tmp_path):
    with subprocess.Popen(
        [sys.executable, "-c", HOLDER, tmp_path], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout.readline() == "held\n"
        yield process
        process.kill()


def test_a_second_writer_is_refused_with_the_holder(tmp_path, holder):
    told = rf"is being written by process {holder.pid} on .*, since 2"
    with pytest.raises(FolderInUse, match=told), only_writer(tmp_path):
        pass


def test_a_lock_is_free_when_its_holder_was_killed(tmp_path, holder):
    holder.send_signal(signal.SIGKILL)
    holder.wait()
    with only_writer(tmp_path):
        pass


def test_a_lock_can_be_taken_again_and_again(tmp_path):
    for _ in range(3):
        with only_writer(tmp_path):
            assert (tmp_path / "lock").stat().st_size > 0
    assert (tmp_path / "lock").stat().st_size == 0


@pytest.mark.parametrize("text", ["", "no JSON", "[]", '{"process": "1"}'])
def test_a_holder_that_cannot_be_read_is_another_process(tmp_path, holder, text):
    (tmp_path / "lock").write_text(text)
    with pytest.raises(FolderInUse, match="by another process"), only_writer(tmp_path):
        pass


def test_a_lock_that_is_a_link_is_refused_and_what_it_leads_to_is_left(tmp_path):
    (tmp_path / "mine").write_text("precious")
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "lock").symlink_to("../mine")
    with pytest.raises(OSError, match="lock"), only_writer(tmp_path / "run"):
        pass
    assert (tmp_path / "mine").read_text() == "precious"


def test_an_interrupt_leaves_no_name_in_the_file(tmp_path):
    with pytest.raises(KeyboardInterrupt), only_writer(tmp_path):
        raise KeyboardInterrupt
    assert (tmp_path / "lock").read_bytes() == b""
