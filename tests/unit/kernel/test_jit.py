import os
import subprocess
import sys
from pathlib import Path

import numba
import pytest

import bbsd
from bbsd.kernel.jit import jit, with_widest_vectors
from bbsd.kernel.modules import load_kernel

ROOT = Path(bbsd.__file__).parent.parent
SOURCE = "def double(x):\n    return 2.0 * x\n"
CALLER = """
from bbsd.kernel.jit import jit
from callee import step, SIZE

@jit
def total(n):
    return step(n) * SIZE

print(total(3))
print(sum(total.stats.cache_hits.values()))
"""


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("BBSD_CACHE_DIR", str(tmp_path / "cache"))
    return tmp_path / "cache"


def run(program: str, folder: Path) -> list[str]:
    """Return the words that a program prints in a process of its own, started in a folder."""
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join([str(ROOT), str(folder)]),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    (folder / "program.py").write_text(program)
    command = [sys.executable, "-W", "error", "program.py"]
    return subprocess.run(
        command, cwd=folder, env=environment, check=True, capture_output=True, text=True
    ).stdout.split()


def callee(step: int, size: int) -> str:
    return f"from bbsd.kernel.jit import jit\nSIZE = {size}\n@jit\ndef step(n):\n    return n + {step}\n"


KERNEL = """
from bbsd.kernel import functions, jit

library = {each.py_func.__name__: each for each in jit.LIBRARY}

@jit.jit
def total(n):
    return functions.atan(n + 0.5) + functions.clamp_index(n, WORD)

print(round(total(2.0), 5))
print(*(sum(library[name].stats.cache_misses.values()) for name in ("atan", "clamp_index")))
print(len(library["clamp_index"].signatures))
"""


@pytest.mark.slow
def test_the_library_is_compiled_once_for_all_kernels_whatever_literals_they_call_it_with(
    tmp_path: Path,
) -> None:
    found = []
    for word in "57":
        (tmp_path / "kernel.py").write_text(KERNEL.replace("WORD", word))
        found.append(run("import kernel", tmp_path))
    assert found == [["3.19029", "1", "1", "1"], ["3.19029", "0", "0", "1"]]


def test_division_by_zero_is_an_infinity() -> None:
    @jit
    def quotient(a: float, b: float) -> float:
        return a / b

    assert quotient(1.0, 0.0) == float("inf")


def test_compiled_code_lies_in_the_cache(cache: Path) -> None:
    load_kernel(SOURCE, "doubles", ("double",), compiled=True).double(1.0)
    assert list((cache / "compiled").glob("*/*/*/doubles_*.nbi"))
    assert not list((cache / "kernels").glob("**/*.nbi"))


def test_the_user_s_own_numba_cache_stays_where_it_was() -> None:
    before = vars(numba.config)["CACHE_DIR"]
    jit(lambda x: x)
    assert before == vars(numba.config)["CACHE_DIR"]


@pytest.mark.slow
def test_another_process_finds_the_compiled_code(tmp_path: Path) -> None:
    (tmp_path / "callee.py").write_text(callee(step=1, size=1))
    (tmp_path / "caller.py").write_text(CALLER)
    assert [run("import caller", tmp_path), run("import caller", tmp_path)] == [["4", "0"], ["4", "1"]]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changed", "total"), [({"step": 2, "size": 1}, "5"), ({"step": 1, "size": 10}, "40")]
)
def test_a_changed_callee_or_constant_of_another_file_is_noticed(
    tmp_path: Path, changed: dict[str, int], total: str
) -> None:
    (tmp_path / "caller.py").write_text(CALLER)
    (tmp_path / "callee.py").write_text(callee(step=1, size=1))
    assert run("import caller", tmp_path) == ["4", "0"]
    (tmp_path / "callee.py").write_text(callee(**changed))
    assert run("import caller", tmp_path) == [total, "0"]


@pytest.mark.slow
@pytest.mark.parametrize("first", ["", "import numba; "], ids=["bbsd first", "numba first"])
def test_numba_s_configuration_in_the_working_folder_is_not_read(tmp_path: Path, first: str) -> None:
    (tmp_path / ".numba_config.yaml").write_text('opt: "0"\ncache_dir: elsewhere\n')
    program = f"{first}from bbsd.kernel.jit import jit; jit(lambda x: x)(1.0); import numba; "
    assert run(program + "print(int(numba.config.OPT), repr(numba.config.CACHE_DIR))", tmp_path) == [
        "3",
        "''",
    ]


@pytest.mark.slow
def test_a_broken_configuration_in_the_working_folder_does_no_harm(tmp_path: Path) -> None:
    (tmp_path / ".numba_config.yaml").write_text("{")
    assert run("from bbsd.kernel.jit import jit; print(jit(lambda x: x + 1)(1))", tmp_path) == ["2"]


@pytest.mark.parametrize("host", ["+avx2,-avx512f", "", "+neon"])
def test_vectors_are_left_as_they_are_where_there_are_no_wider_ones(host: str) -> None:
    assert with_widest_vectors(host) == host


def test_the_widest_vectors_are_used() -> None:
    assert with_widest_vectors("+avx2,+avx512f") == "+avx2,+avx512f,-prefer-256-bit"


@pytest.mark.slow
def test_the_user_s_own_features_are_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_CPU_FEATURES", "+sse2")
    program = "from bbsd.kernel.jit import jit; import numba; print(numba.config.CPU_FEATURES, jit(lambda x: x + 1)(1))"
    assert run(program, tmp_path) == ["+sse2", "2"]
