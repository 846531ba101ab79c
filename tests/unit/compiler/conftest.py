import pytest

from tests.unit.problems import RICH, problem_of


@pytest.fixture(scope="session")
def rich_compiled():
    return problem_of(RICH, lanes=16, compiled=True)
