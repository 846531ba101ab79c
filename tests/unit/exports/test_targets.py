import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bbsd.architecture import joint_space
from bbsd.architecture.deciding import policy_at
from bbsd.cli.export import TargetName
from bbsd.exports.exported import Options, exported_design
from bbsd.exports.targets import TARGETS
from bbsd.exports.verification.comparing import cells_to_compare
from tests.interpreter.made_up import specs
from tests.interpreter.made_up_meanings import meaning_made_up
from tests.unit.architecture.designs import random_architecture
from tests.unit.exports.designs import answers, hand_made


def test_the_command_knows_all_targets():
    assert {*TARGETS} == {each.value for each in TargetName}


def test_every_target_carries_the_digest_in_its_main_file():
    exported = hand_made("object_lifting_hand")
    for target in TARGETS.values():
        text = next(iter(target.write(exported, Options()).values()))
        assert exported.controller.digest in text
        assert text.endswith("\n")


def all_ways():
    for name, target in TARGETS.items():
        for leaves in ("script", "custom") if name == "btcpp" else ("script",):
            for runner in target.runners:
                yield pytest.param(target, runner, leaves, id=f"{name}-{leaves}-{runner.tool}")


@pytest.mark.slow
@pytest.mark.parametrize(("target", "runner", "leaves"), [*all_ways()])
@settings(max_examples=8, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data(), seed=st.integers(0, 10**6))
def test_made_up_designs_decide_the_same_in_every_target(target, runner, leaves, data, seed):
    meaning = meaning_made_up(data.draw(specs(most_robots=3)), seed)
    exported = exported_design(meaning, random_architecture(meaning, seed))
    cells = cells_to_compare(exported, 2000)
    expected = policy_at(joint_space(meaning), exported.architecture, cells)
    found = answers(runner.run, exported, target.write(exported, Options(leaves=leaves)), cells)
    assert found.tolist() == expected.tolist()
