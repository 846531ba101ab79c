"""What is on the disk after a simulated loss of power: no less than what was brought there, and no more."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system cannot fork processes")

BEGIN = """
import os, sys, threading, time
from pathlib import Path
from bbsd.files import sync_folder, write_whole
from fuzzing.faults.system import System

root, fault, number = Path(sys.argv[1]), sys.argv[2], int(sys.argv[3])
"""
ALONE = """
(root / "log").write_text("kept,")
(root / "old").write_text("old")
System(root, fault, number).install()
log = os.open(root / "log", os.O_WRONLY | os.O_APPEND)  # call 1
os.write(log, b"synced,")
os.fsync(log)
os.write(log, b"not synced")
os.replace(root / "old", root / "new")
os.mkdir(root / "folder")
(root / "folder" / "file").unlink(missing_ok=True)
write_whole(root / "new", b"whole")  # calls 8 to 14: open, write, fchmod, fsync, replace, open and fsync its folder
os.unlink(root / "new")
"""
BESIDE = """
done, real = threading.Event(), os.fsync

def slow_fsync(descriptor):
    real(descriptor)
    done.set()
    time.sleep(0.2)  # whatever else this process does, it does now

os.fsync = slow_fsync
System(root, fault, 4).install()  # after open, write and fsync
thread = threading.Thread(target=write_whole, args=(root / "state", b"x" * 1000))
thread.start()
done.wait()
os.mkdir(root / "next")
thread.join()
"""
STREAM = """
(root / "read").write_text("read")
system = System(root, fault, number)
system.install()
with os.fdopen(os.open(root / "read", os.O_RDONLY)):
    pass
other = os.open(sys.argv[4], os.O_WRONLY | os.O_CREAT)
os.write(other, b"other")
os.fsync(other)
print(system.calls)
"""


def lost(root, script, fault="power", number=0, *more):
    """Run a script until the power is lost, and return the files that are left."""
    command = [sys.executable, "-c", BEGIN + script, root, fault, str(number), *more]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == -signal.SIGKILL, ended.stderr
    return {path.name: path.read_text() if path.is_file() else "a folder" for path in Path(root).iterdir()}


@pytest.mark.parametrize(
    ("number", "left"),
    [
        (2, {"log": "kept,", "old": "old"}),
        (3, {"log": "kept,", "old": "old"}),
        (5, {"log": "kept,synced,", "old": "old"}),
        (7, {"log": "kept,synced,", "new": "old", "folder": "a folder"}),
        (13, {"log": "kept,synced,", "new": "whole", "folder": "a folder"}),
        (15, {"log": "kept,synced,", "new": "whole", "folder": "a folder"}),
    ],
)
def test_bytes_are_lost_that_were_not_brought_to_the_disk(tmp_path, number, left):
    assert lost(tmp_path, ALONE, "power", number) == left


@pytest.mark.parametrize(
    ("number", "left"),
    [
        (5, {"log": "kept,synced,", "old": "old"}),
        (7, {"log": "kept,synced,", "old": "old"}),
        (13, {"log": "kept,synced,", "old": "old"}),
        (15, {"log": "kept,synced,", "new": "whole", "folder": "a folder"}),
    ],
)
def test_names_are_lost_that_were_not_brought_to_the_disk_with_their_folder(tmp_path, number, left):
    root = tmp_path / "root"
    root.mkdir()
    assert lost(root, ALONE, "names", number) == left


def test_power_is_not_lost_in_the_middle_of_another_threads_call(tmp_path):
    (content,) = lost(tmp_path, BESIDE).values()
    assert content == "x" * 1000


def test_a_number_of_a_descriptor_that_a_stream_has_closed_is_not_that_file(tmp_path):
    root = tmp_path / "root"
    root.mkdir()
    command = [sys.executable, "-c", BEGIN + STREAM, root, "none", "0", tmp_path / "other"]
    ended = subprocess.run(command, capture_output=True, text=True, check=True)
    assert ended.stdout.strip() == f"['open to read {root}/read']"
