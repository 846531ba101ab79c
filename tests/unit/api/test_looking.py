"""The spaces of environments, of specs that are not complete too."""

import pytest

import bbsd
from bbsd.api import NoEnvironment
from bbsd.environments.importing.consent import ImportNotAllowed
from bbsd.errors import SpecError
from tests.unit.environments.arenas import ALLOWED, HERE

ACCESS = {"allow_import": ALLOWED.modules, "import_from": ALLOWED.folders}


@pytest.fixture
def spec(tmp_path):
    def write(environment, more=""):
        path = tmp_path / "spec.yaml"
        path.write_text(f"bbsd: 1\nname: looked at\nenvironment: {environment}\n{more}", encoding="utf-8")
        return path

    return write


def test_a_spec_need_only_name_it(spec):
    found = bbsd.spaces(spec(f"{{python: '{HERE}:Line', with: {{length: 9}}, steps: 30}}"), **ACCESS)
    assert found.observation == "Box(-inf, inf, (2,), float64)"
    assert found.action == "unknown"
    assert (found.agents, found.step_limit, found.mistakes) == ((), None, None)
    assert "length: 9" in found.proposal
    assert "steps: 30" in found.proposal


def test_agents_are_the_robots(spec):
    found = bbsd.spaces(python=f"{HERE}:Duet", **ACCESS)
    assert found.agents == ("left", "right")
    assert "  robots: 2\n" in str(found)


def test_none_is_looked_at_without_consent():
    with pytest.raises(ImportNotAllowed):
        bbsd.spaces(python=f"{HERE}:Line")


@pytest.mark.parametrize(
    ("environment", "words"),
    [
        ("{steps: 4}", "and there is none"),
        ("{python: 'a:B', gymnasium: C-v1}", "and there is gymnasium and python"),
        ("{python: a/b.py}", "cannot be the name"),
        ("{python: 7}", "cannot be the name"),
        ("{python: 'a:B', with: 7}", "with must be a mapping"),
        ("7", "no block environment"),
    ],
)
def test_a_spec_that_names_none_is_told(spec, environment, words):
    with pytest.raises(NoEnvironment, match=words):
        bbsd.spaces(spec(environment), **ACCESS)


def test_a_spec_that_cannot_be_read_is_told(spec):
    with pytest.raises(SpecError):
        bbsd.spaces(spec("{python: [}"), **ACCESS)


def test_one_that_is_not_there_is_told_at_its_place_or_without_one(spec):
    with pytest.raises(SpecError) as located:
        bbsd.spaces(spec(f"{{python: '{HERE}:Lin'}}"), **ACCESS)
    assert [(each.code, each.place.line) for each in located.value.diagnoses] == [("BB121", 3)]
    with pytest.raises(NoEnvironment, match='did you mean "Line"'):
        bbsd.spaces(python=f"{HERE}:Lin", **ACCESS)


COMPLETE = "behaviors: {b: {actions: {go: {move: 1}}}}\nreward: {earned: earned}\n"


def test_a_complete_spec_is_compared_with_it(spec):
    told = f"{{python: '{HERE}:Line', steps: 3, observation: NAMES, action: move, state: {{move: 0}}}}"
    assert bbsd.spaces(spec(told.replace("NAMES", "[a, b]"), COMPLETE), **ACCESS).mistakes is None
    mistakes = bbsd.spaces(spec(told.replace("NAMES", "[a]"), COMPLETE), **ACCESS).mistakes
    assert [each.code for each in mistakes.diagnoses] == ["BB113"]


def test_overrides_may_name_another_one(spec):
    path = spec(f"{{python: '{HERE}:Line', robots: 2}}")
    found = bbsd.spaces(path, set=[f"environment.python={HERE}:Duet"], **ACCESS)
    assert found.target == f"{HERE}:Duet"
