from __future__ import annotations

import sys
from io import BytesIO, StringIO, TextIOWrapper

import pytest

from bbsd.cli.terminal.output import has_blocks, has_color, require_writable_file, show


class Terminal(StringIO):
    def isatty(self):
        return True


def test_data_ends_in_one_line_break(capsys):
    for text in ("a", "b\n", ""):
        show(text)
    assert capsys.readouterr().out == "a\nb\n"


def test_color_is_for_terminals_that_have_and_want_it(monkeypatch):
    for name in ("NO_COLOR", "TERM"):
        monkeypatch.delenv(name, raising=False)
    assert has_color(Terminal())
    assert not has_color(StringIO())
    monkeypatch.setenv("TERM", "dumb")
    assert not has_color(Terminal())
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("NO_COLOR", "1")
    assert not has_color(Terminal())


@pytest.mark.parametrize(("encoding", "expected"), [("utf-8", True), ("ascii", False), ("latin-1", False)])
def test_block_characters_need_a_unicode_encoding(monkeypatch, encoding, expected):
    monkeypatch.setattr(sys, "stdout", TextIOWrapper(BytesIO(), encoding=encoding))
    assert has_blocks() is expected


def test_a_file_can_be_written_where_its_folder_is(tmp_path):
    require_writable_file(tmp_path / "new.csv")
    (tmp_path / "old.csv").write_text("")
    require_writable_file(tmp_path / "old.csv")


@pytest.mark.parametrize(("name", "error"), [("", IsADirectoryError), ("nowhere/new.csv", FileNotFoundError)])
def test_where_no_file_can_be_written_is_found_beforehand(tmp_path, name, error):
    with pytest.raises(error) as raised:
        require_writable_file(tmp_path / name)
    assert raised.value.filename


def test_a_file_that_may_not_be_written_is_found_beforehand(tmp_path, monkeypatch):
    monkeypatch.setattr("os.access", lambda path, mode: False)
    with pytest.raises(PermissionError):
        require_writable_file(tmp_path / "new.csv")
