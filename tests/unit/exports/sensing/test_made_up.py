"""Specs that are made up, in C: it does what the design does, to the last bit."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bbsd.architecture import Architecture
from bbsd.compiler import compile_meaning
from bbsd.exports.exported import Options, exported_design
from bbsd.exports.sensing.header import write
from bbsd.exports.verification.compilers import STRICT
from bbsd.exports.verification.following import follow
from tests.interpreter.made_up import specs
from tests.interpreter.made_up_designs import random_agents
from tests.interpreter.made_up_meanings import meaning_made_up
from tests.unit.exports.designs import tool

SANITIZED = (*STRICT, "-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")


@pytest.mark.slow
@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data(), seed=st.integers(0, 10**6))
def test_made_up_designs_do_the_same_in_c(data, seed):
    tool("gcc")
    meaning = meaning_made_up(data.draw(specs(most_robots=3)), seed)
    agents = random_agents(compile_meaning(meaning, compiled=False), 1, seed)
    tables = tuple(pool[member] for pool, member in zip(agents.pools, agents.members[0], strict=True))
    exported = exported_design(meaning, Architecture(tables, agents.structures[0]))
    state = [name for name in ("x", "flag") if data.draw(st.booleans())]
    sensors = [name for name in ("level", "eyes", "kind") if data.draw(st.integers(0, 3)) == 0]
    options = Options(sensing=True, measured=(*state, *sensors))
    followed = follow(exported, options, write(exported, options), 1, flags=SANITIZED)
    assert not followed.failure
    assert followed.is_equal, followed.first_difference
