import os
import signal
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

GOLDEN = Path(__file__).parent / "golden"

os.environ.setdefault("BBSD_CACHE_DIR", str(Path(__file__).parents[1] / ".cache" / "tests"))

# A shell's background process ignores interrupts, and so would all that the tests start and interrupt.
signal.signal(signal.SIGINT, signal.default_int_handler)

# A tree passes or fails, the same on each machine; new examples are looked for with `make examples`. No deadlines:
# machines differ, and a first call may compile; for the same reason it is no failure that examples come slowly.
PATIENT = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow]}
settings.register_profile("same", derandomize=True, **PATIENT)
settings.register_profile("quick", derandomize=True, max_examples=20, **PATIENT)
settings.register_profile("new", print_blob=True, **PATIENT)
settings.load_profile("same")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update-golden", action="store_true", help="write what the tests produce into tests/golden"
    )


@pytest.fixture
def golden(request: pytest.FixtureRequest) -> Callable[..., None]:
    """Compare a text with the file of that name in tests/golden, or write it there with --update-golden."""

    def compare(name: str, text: str, hint: str = "it is another text") -> None:
        path = GOLDEN / name
        if request.config.getoption("--update-golden"):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8", newline="\n")
        assert path.exists(), f"there is no {path}; run pytest --update-golden and read what it writes"
        assert text == path.read_text(encoding="utf-8"), hint

    return compare
