import errno
import os
from pathlib import Path

import numpy as np
import pytest

from bbsd.kernel.cache import DIGEST_SIZE
from bbsd.kernel.compiled_files import checked_content, keep_compiled
from bbsd.kernel.jit import OPTIONS, _cached_in, numba


def doubled(x: float) -> float:
    return 2 * x


def dispatcher(folder: Path):
    """`doubled`, to be compiled and kept in a folder, as a new process has it."""
    with _cached_in(folder):
        made = numba.njit(**OPTIONS)(doubled)
        keep_compiled(made, doubled)
    return made


def hits(made) -> int:
    return sum(made.stats.cache_hits.values())


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder in which `doubled` is kept."""
    made = dispatcher(tmp_path)
    assert (made(1.5), hits(made)) == (3.0, 0)
    return tmp_path


def files(folder: Path, suffix: str) -> list[Path]:
    return sorted(folder.rglob(f"*{suffix}"))


def test_what_is_kept_is_used_again(folder: Path) -> None:
    made = dispatcher(folder)
    assert (made(1.5), hits(made)) == (3.0, 1)


@pytest.mark.parametrize("suffix", [".nbi", ".nbc"])
def test_a_damaged_file_is_made_anew_whatever_happened_to_it(folder: Path, suffix: str) -> None:
    (path,) = files(folder, suffix)
    whole = path.read_bytes()
    rng = np.random.default_rng(0)
    flips = rng.integers(len(whole), size=20)
    damaged = [b"", whole[:1], whole[:-1], whole[: len(whole) // 2], whole + b"\0", b"\0" * len(whole)]
    damaged += [whole[:at] + bytes([whole[at] ^ 1 << at % 8]) + whole[at + 1 :] for at in flips]
    for content in damaged:
        path.write_bytes(content)
        made = dispatcher(folder)
        assert (made(1.5), hits(made)) == (3.0, 0)
        assert checked_content(path) is not None
        again = dispatcher(folder)
        assert (again(1.5), hits(again)) == (3.0, 1)


def test_every_flipped_bit_of_a_file_is_noticed_and_the_file_removed(folder: Path) -> None:
    (path,) = files(folder, ".nbi")
    whole = path.read_bytes()
    assert checked_content(path) == whole[:-DIGEST_SIZE]
    for at in range(len(whole)):
        path.write_bytes(whole[:at] + bytes([whole[at] ^ 1 << at % 8]) + whole[at + 1 :])
        assert checked_content(path) is None
        assert not path.exists()


def test_what_cannot_be_kept_is_said_once_and_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    made = dispatcher(tmp_path)
    monkeypatch.setattr(type(made._cache._cache_file), "_save", full)
    assert made(1.5) == 3.0
    assert made(np.float32(1.5)) == 3.0
    said = capsys.readouterr().err
    assert said.count("No space left on device") <= 1  # another test of this process may have said it
    assert not files(tmp_path, ".nbc")


def test_a_folder_that_cannot_be_made_is_no_mistake(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    assert dispatcher(tmp_path / "file" / "below")(1.5) == 3.0
