import numpy as np
import pytest

from bbsd.architecture import joint_space, policy
from bbsd.architecture.deciding import asked_at, cells_at, excited_at, policy_at
from bbsd.architecture.policy import controlling, decisions, own_cells
from tests.unit.architecture.designs import meaning_of, random_architecture, shipped
from tests.unit.problems import RICH


def every_situation(space):
    return np.stack(np.unravel_index(np.arange(space.joint_size), space.sizes), axis=1)


@pytest.mark.parametrize("text", [RICH, shipped("object_lifting")], ids=["rich", "lifting"])
@pytest.mark.parametrize("seed", range(3))
def test_situations_are_decided_as_in_the_whole_space(text, seed):
    meaning = meaning_of(text)
    space, design = joint_space(meaning), random_architecture(meaning, seed)
    cells = every_situation(space)
    assert np.array_equal(policy_at(space, design, cells), policy(space, design))
    for behavior, table in enumerate(design.tables):
        own = np.broadcast_to(own_cells(space, behavior), space.sizes).ravel()
        assert np.array_equal(cells_at(space, behavior, cells), own)
        acts = np.broadcast_to(decisions(space, behavior, np.ones_like(table)), space.sizes).ravel()
        assert np.array_equal(excited_at(space, behavior, cells), acts > 0)


@pytest.mark.parametrize("seed", range(3))
def test_asked_are_the_excited_behaviors_down_to_the_one_that_controls(seed):
    meaning = meaning_of(RICH)
    space, design = joint_space(meaning), random_architecture(meaning, seed)
    cells, control = every_situation(space), controlling(space, design)
    layer_of = {behavior: layer for layer, behavior in enumerate(design.structure.tolist())}
    asked = dict(asked_at(space, design, cells))
    assert list(asked) == design.structure[::-1].tolist()
    for behavior, where in asked.items():
        at_or_above = np.array([layer_of[behavior] >= layer_of.get(other, -1) for other in control.tolist()])
        assert np.array_equal(where, excited_at(space, behavior, cells) & at_or_above)
