import errno
import os
import stat
from pathlib import Path

import pytest

from bbsd import files
from bbsd.files import make_folder, move, read_regular, write_text_whole, write_whole

CALLS = ("open", "write", "fsync", "replace")


class Killed(BaseException):
    """As if the process ended here."""


def failing_at(monkeypatch, name, number, error):
    """Let the call of that number of a function of the system fail."""
    calls = iter(range(1, 1000))
    real = getattr(os, name)

    def call(*arguments, **options):
        if next(calls) == number:
            raise error
        return real(*arguments, **options)

    monkeypatch.setattr(files.os, name, call)


def test_a_file_is_written(tmp_path):
    write_text_whole(tmp_path / "a", "ä\r\n")
    assert (tmp_path / "a").read_bytes() == "ä\r\n".encode()
    assert [path.name for path in tmp_path.iterdir()] == ["a"]


@pytest.mark.parametrize("error", [OSError(errno.ENOSPC, "No space left on device"), Killed()], ids=str)
@pytest.mark.parametrize("name", CALLS)
def test_a_fault_leaves_the_old_content_or_the_new_one(tmp_path, monkeypatch, name, error):
    path = tmp_path / "a"
    path.write_bytes(b"old")
    for number in (1, 2):
        with monkeypatch.context() as patch:
            failing_at(patch, name, number, error)
            try:
                write_whole(path, b"new")
            except OSError as raised:
                assert raised.filename == str(path)  # noqa: PT017
            except Killed:
                pass
        assert path.read_bytes() in (b"old", b"new")
        assert [each.name for each in tmp_path.iterdir()] == ["a"]


def test_a_short_write_is_continued(tmp_path, monkeypatch):
    real = os.write
    monkeypatch.setattr(files.os, "write", lambda descriptor, content: real(descriptor, content[:2]))
    write_whole(tmp_path / "a", b"0123456789")
    assert (tmp_path / "a").read_bytes() == b"0123456789"


def test_the_file_and_its_folder_reach_the_disk(tmp_path, monkeypatch):
    synced = []
    real = os.fsync
    monkeypatch.setattr(
        files.os, "fsync", lambda descriptor: synced.append(os.fstat(descriptor).st_mode) or real(descriptor)
    )
    write_whole(tmp_path / "a", b"x")
    assert [stat.S_ISDIR(mode) for mode in synced] == [False, True]


def test_the_mode_of_a_file_is_kept(tmp_path):
    path = tmp_path / "a"
    path.touch()
    path.chmod(0o640)
    write_whole(path, b"x")
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_a_link_is_refused_or_written_through(tmp_path):
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_bytes(b"old")
    link.symlink_to(target)
    with pytest.raises(OSError, match="link") as error:
        write_whole(link, b"new")
    assert error.value.errno == errno.ELOOP
    assert target.read_bytes() == b"old"
    write_whole(link, b"new", through_links=True)
    assert target.read_bytes() == b"new"
    assert link.is_symlink()


def test_a_device_is_written_directly():
    write_whole(Path(os.devnull), b"x")


def test_an_error_of_a_move_names_the_file(tmp_path):
    with pytest.raises(FileNotFoundError) as error:
        move(tmp_path / "none", tmp_path / "a")
    assert error.value.filename == str(tmp_path / "a")


def test_a_folder_is_made_once(tmp_path):
    assert make_folder(tmp_path / "new")
    assert not make_folder(tmp_path / "new")
    (tmp_path / "file").touch()
    with pytest.raises(FileExistsError, match="file"):
        make_folder(tmp_path / "file")


def test_a_regular_file_is_read(tmp_path):
    (tmp_path / "a").write_bytes(b"\r\nabc")
    (tmp_path / "link").symlink_to("a")
    assert read_regular(tmp_path / "a") == read_regular(tmp_path / "link") == b"\r\nabc"
    assert read_regular(tmp_path / "a", 3) == b"\r\na"


@pytest.mark.skipif(os.name == "nt", reason="no pipes with names")
@pytest.mark.parametrize("make", [os.mkdir, os.mkfifo], ids=["folder", "pipe"])
def test_what_is_no_regular_file_is_refused_at_once(tmp_path, make):
    make(tmp_path / "a")
    for path in (tmp_path / "a", tmp_path / "none"):
        with pytest.raises(OSError, match=path.name):
            read_regular(path)
