import os
import stat
from pathlib import Path

import pytest

from bbsd.kernel.cache import cache_folder, cache_root, clean, trim


@pytest.fixture(autouse=True)
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("BBSD_CACHE_DIR", str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_the_cache_is_the_user_s_alone(root: Path) -> None:
    assert cache_folder("kernels") == root / "kernels"
    assert stat.S_IMODE(root.stat().st_mode) == 0o700
    assert stat.S_IMODE((root / "kernels").stat().st_mode) == 0o700


@pytest.mark.parametrize(
    ("variables", "expected"),
    [
        ({"BBSD_CACHE_DIR": "/a/b", "XDG_CACHE_HOME": "/c"}, "/a/b"),
        ({"XDG_CACHE_HOME": "/c"}, "/c/bbsd"),
        ({"XDG_CACHE_HOME": "relative", "HOME": "/home/ann"}, "/home/ann/.cache/bbsd"),
        ({"HOME": "/home/ann"}, "/home/ann/.cache/bbsd"),
    ],
)
def test_where_the_cache_is(
    variables: dict[str, str], expected: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("BBSD_CACHE_DIR", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    assert cache_root() == Path(expected)


def test_a_cache_that_others_can_write_is_not_used(root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    root.mkdir()
    root.chmod(0o777)
    assert root not in cache_folder("kernels").parents
    assert "cannot keep compiled code" in capsys.readouterr().err


def compiled(root: Path, name: str, size: int, used: float) -> Path:
    """A folder of compiled code, and the text of its kernel."""
    for path in (
        root / "compiled" / "1" / name / f"{name}.rollout.1.nbc",
        root / "kernels" / "1" / f"{name}.py",
    ):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(bytes(size))
        os.utime(path, (used, used))
    return root / "compiled" / "1" / name


def test_a_cache_is_bounded_and_what_was_not_used_longest_goes_first(root: Path) -> None:
    old, young, older = (compiled(root, *each) for each in [("a", 100, 2), ("b", 100, 3), ("c", 100, 1)])
    trim(root, most=600)
    assert all(path.exists() for path in (older, old, young))
    trim(root, most=599)
    assert [path.exists() for path in (older, old, young)] == [False, True, True]
    assert [path.stem for path in sorted((root / "kernels").rglob("*.py"))] == ["a", "b"]
    trim(root, most=0)
    assert not list(root.rglob("*.*"))
    trim(root / "nowhere", most=0)


def test_a_cache_can_be_cleaned(root: Path) -> None:
    compiled(root, "a", 100, 2)
    assert clean(root) == 200
    assert not list(root.rglob("*.*"))
    assert clean(root) == 0
