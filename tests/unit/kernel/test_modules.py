import os
import subprocess
import sys
from pathlib import Path

import pytest

from bbsd.kernel.cache import cache_folder
from bbsd.kernel.modules import load_kernel

SOURCE = """
from bbsd.kernel.functions import divide

def half(x):
    return divide(x, 2.0)

def quarter(x):
    return half(half(x))
"""


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("BBSD_CACHE_DIR", str(tmp_path / "cache"))
    return tmp_path / "cache"


def source_with(line: str) -> str:
    return f"{SOURCE}\n{line}\n"


@pytest.mark.parametrize("compiled", [False, True])
def test_a_loaded_kernel_computes(compiled: bool) -> None:
    assert load_kernel(SOURCE, "halves", ("half", "quarter"), compiled).quarter(1.0) == 0.25


def test_a_plain_kernel_is_plain_python() -> None:
    kernel = load_kernel(SOURCE, "halves", ("half",), compiled=False)
    assert type(kernel.half).__name__ == "function"


def test_the_same_source_is_the_same_module_and_file(cache: Path) -> None:
    source = source_with("SAME = 1")
    first = load_kernel(source, "halves", ("half",), compiled=False)
    written = Path(str(first.__file__)).stat()
    sys.modules.pop(first.__name__)
    again = load_kernel(source, "halves", ("half",), compiled=False)
    assert (again.__name__, again.__file__) == (first.__name__, first.__file__)
    assert Path(str(again.__file__)).stat().st_mtime_ns == written.st_mtime_ns
    assert [path.name for path in (cache / "kernels").rglob("*.py")] == [
        f"{again.__name__.removesuffix('_plain')}.py"
    ]
    assert load_kernel(source, "halves", ("half",), compiled=False) is again


def test_another_source_is_another_file(cache: Path) -> None:
    for number in range(3):
        load_kernel(source_with(f"OTHER = {number}"), "halves", ("half",), compiled=False)
    assert len(list((cache / "kernels").rglob("halves_*.py"))) == 3


def test_a_damaged_file_is_written_again() -> None:
    source = source_with("DAMAGED = 1")
    module = load_kernel(source, "halves", ("half",), compiled=False)
    Path(str(module.__file__)).write_text("raise SystemExit\n")
    sys.modules.pop(module.__name__)
    assert load_kernel(source, "halves", ("half",), compiled=False).half(3.0) == 1.5


def test_a_source_that_fails_leaves_no_module() -> None:
    with pytest.raises(ZeroDivisionError):
        load_kernel("1 / 0", "broken", (), compiled=False)
    assert not [name for name in sys.modules if name.startswith("broken_")]


def test_an_unwritable_cache_is_replaced_for_the_process_with_one_notice(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("BBSD_CACHE_DIR", str(tmp_path / "file" / "cache"))
    kernel = load_kernel(source_with("UNWRITABLE = 1"), "halves", ("half",), compiled=True)
    assert kernel.half(3.0) == 1.5
    assert cache_folder("kernels") == Path(os.environ["BBSD_CACHE_DIR"]) / "kernels"
    (notice,) = capsys.readouterr().err.splitlines()
    assert notice.startswith(f"bbsd: cannot keep compiled code in {tmp_path}/file/cache; set BBSD_CACHE_DIR")


def test_plain_kernels_need_no_numba() -> None:
    program = f"""
import sys
from bbsd.kernel.modules import load_kernel
assert load_kernel({SOURCE!r}, "halves", ("half",), compiled=False).half(3.0) == 1.5
assert "numba" not in sys.modules and "numpy" not in sys.modules
"""
    subprocess.run([sys.executable, "-W", "error", "-c", program], check=True)
