from __future__ import annotations

import sys

from bbsd.kernel import cache, modules
from bbsd.report import health


def finding(name):
    return next(each for each in health.examine() if each.name == name)


def test_nothing_is_wrong_here():
    assert [finding for finding in health.examine() if finding.problem] == []


def test_plain_python_and_what_is_compiled_are_told_apart(monkeypatch):
    def broken(*_):
        raise OSError("no compiler")

    monkeypatch.setattr(modules, "_compile", broken)
    monkeypatch.setattr(health, "SELF_CHECK_SPEC", health.SELF_CHECK_SPEC.replace("known", "unknown"))
    assert not finding("self-check").problem
    assert finding("compiled").problem == "OSError: no compiler; if it lasts: bbsd doctor --clean"


def kept(root, version):
    """The folder of compiled code of a version."""
    root.mkdir(mode=0o700, exist_ok=True)
    folder = root / "compiled" / version
    folder.mkdir(parents=True, mode=0o700)
    return folder


def test_damaged_files_of_the_cache_are_counted(monkeypatch, tmp_path):
    root = tmp_path / "cache"
    monkeypatch.setenv(cache.CACHE_VARIABLE, str(root))
    folder = kept(root, cache.kernel_digest())
    (folder / "a.nbc").write_bytes(cache.with_digest(b"whole"))
    assert finding("cache").value.endswith("writable, 1 file, 0.0 MB")
    (folder / "b.nbi").write_bytes(b"")
    assert finding("cache").value.endswith("2 files, 0.0 MB; 1 file, 0.0 MB damaged: made anew when needed")


def test_files_of_another_version_are_not_called_damaged(monkeypatch, tmp_path):
    root = tmp_path / "cache"
    monkeypatch.setenv(cache.CACHE_VARIABLE, str(root))
    (kept(root, "0123456789abcdef") / "a.nbi").write_bytes(bytes(1_500_000))
    (kept(root, cache.kernel_digest()) / "a.nbi").write_bytes(cache.with_digest(bytes(500_000)))
    assert not finding("cache").problem
    assert finding("cache").value.removeprefix(f"{root}, writable, ") == (
        "2 files, 2.0 MB; 1 file, 1.5 MB of other versions of bbsd or numba, which this one does not use: "
        "bbsd doctor --clean empties the cache"
    )
    cache.clean(root)
    cache.usable.cache_clear()
    assert finding("cache").value == f"{root}, writable, 0 files, 0.0 MB"


def test_another_result_than_everywhere_is_wrong(monkeypatch):
    monkeypatch.setattr(health, "SELF_CHECK_RETURN", "0x1.0p+0")
    assert "0x1.0p+0" in finding("self-check").problem


def test_a_self_check_that_fails_is_reported(monkeypatch):
    monkeypatch.setattr(health, "SELF_CHECK_SPEC", "bbsd: 2\n")
    assert finding("self-check").problem.startswith("SpecError")


def test_a_missing_package_is_wrong_but_for_figures(monkeypatch):
    def missing(_):
        raise health.PackageNotFoundError

    monkeypatch.setattr(health, "version", missing)
    assert finding("numba").problem == "install it: python -m pip install numba"
    assert not finding("matplotlib").problem


def test_numba_that_does_not_compile_is_wrong(monkeypatch):
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    assert finding("compiler").problem


def test_a_cache_that_others_can_write_is_wrong(monkeypatch, tmp_path):
    tmp_path.chmod(0o777)
    monkeypatch.setenv(cache.CACHE_VARIABLE, str(tmp_path))
    assert "cannot be used" in finding("cache").problem


def test_a_cache_is_where_it_is_said_to_be_and_as_large_as_it_is(monkeypatch, tmp_path):
    root = tmp_path / "cache"
    monkeypatch.setenv(cache.CACHE_VARIABLE, str(root))
    folder = root / "kernels" / cache.kernel_digest()
    folder.mkdir(parents=True)
    root.chmod(0o700)
    (root / "kernels").chmod(0o700)
    (folder / "a").write_bytes(bytes(2_000_000))
    assert finding("cache").value == f"{root}, writable, 1 file, 2.0 MB"


def test_a_python_that_is_too_old_is_wrong(monkeypatch):
    monkeypatch.setattr(sys, "version_info", (3, 10))
    assert finding("Python").problem
