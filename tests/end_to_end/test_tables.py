"""Commands on environments with a table of transitions: what is used, what is told, what is kept."""

import json

import pytest

import bbsd as api
from bbsd.api.evaluating import NoSingleEpisodes
from bbsd.api.given.environments import opened_environment
from bbsd.evaluation import NotEnumerable
from bbsd.runs.storage.folder import FolderError
from experiments.tables import Row, line
from tests.end_to_end.commands import bbsd
from tests.unit.tabular import CLIFF, LAKE, TAXI

ALLOWED = {"allow_import": ["gymnasium"]}
ALONG_THE_EDGE = {36: "a", **dict.fromkeys(range(24, 35), "b"), 35: "c"}


@pytest.fixture
def walker(tmp_path):
    """A design that goes along the cliff to its end."""
    rules = "".join(f"      - {{when: {{place: {at}}}, do: {way}}}\n" for at, way in ALONG_THE_EDGE.items())
    text = CLIFF.replace(
        "reward:", f"    rules:\n{rules}      - otherwise: no action\nstructure: [walk]\nreward:"
    )
    path = tmp_path / "walker.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def written(tmp_path, text):
    path = tmp_path / "spec.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_evaluate_tells_that_a_table_is_used_and_gives_exact_mean_and_optimum(walker):
    code, out, err = bbsd("evaluate", walker, "--allow-import", "gymnasium", "--exact")

    assert code == 0
    told = "CliffWalking-v1 is stepped by its table of transitions (48 states, 4 actions)"
    assert told in err
    assert "-13" in out
    assert "optimum of any controller that sees the state: -13" in out
    assert "all 1 start, and all that chance may do, in 13 steps" in out


def test_json_has_the_optimum(walker):
    _, out, _ = bbsd("evaluate", walker, "--allow-import", "gymnasium", "--exact", "--json")
    found = json.loads(out)

    assert found["exact"]
    assert found["return"]["mean"] == -13
    assert found["optimum"] == {"best": -13, "fixed": -13}


@pytest.mark.slow
def test_stepping_in_python_is_told_by_an_option_and_gives_the_same(walker):
    command = ("evaluate", walker, "--allow-import", "gymnasium", "--episodes", 3)
    (_, by_table, _), (_, in_python, told) = bbsd(*command), bbsd(*command, "--step-in-python")

    assert "table of transitions" not in told
    assert in_python == by_table


def test_traces_of_both_are_the_same(walker):
    traces = [api.trace(walker, by_table=by_table, **ALLOWED) for by_table in (True, False)]

    assert traces[0].values == traces[1].values
    assert traces[0].start == traces[1].start
    assert len(traces[0].steps) == 13


def test_an_environment_that_does_not_keep_to_its_table_is_stepped_in_python(tmp_path):
    notes = []
    text = TAXI.replace("observation:", "with: {fickle_passenger: true}\n  observation:")
    opened = opened_environment(api.load(written(tmp_path, text)), **ALLOWED, note=notes.append)

    assert opened.table is None
    (note,) = notes
    assert note.startswith("Taxi-v4 has a table of transitions, but is stepped in Python: action ")


def test_an_action_that_the_table_does_not_have_is_left_to_the_environment(tmp_path):
    notes = []
    text = LAKE.replace("{way: 3}", "{way: square % 4}")
    opened = opened_environment(api.load(written(tmp_path, text)), **ALLOWED, note=notes.append)

    assert opened.table is None
    (note,) = notes
    assert note.startswith("FrozenLake-v1 has a table of transitions, but is stepped in Python: way might be")


def test_what_exact_cannot_be_is_said(walker):
    with pytest.raises(NoSingleEpisodes, match="no single episodes"):
        api.evaluate(walker, exact=True, keep_each=True, **ALLOWED)
    with pytest.raises(NotEnumerable, match="stepped in Python"):
        api.evaluate(walker, exact=True, by_table=False, **ALLOWED)


@pytest.mark.slow
def test_a_design_is_by_the_table_and_says_so_in_its_folder(tmp_path):
    spec = written(tmp_path, LAKE)
    found = api.design(spec, set=["design.budget=5000"], out=tmp_path / "run", **ALLOWED)
    identity = json.loads((found.folder / "run.json").read_text(encoding="utf-8"))

    assert len(identity["environment"]["table"]) == 32
    assert identity["reproducible"] is True
    assert api.evaluate(found.architecture, exact=True, **ALLOWED).mean > 0.1
    with pytest.raises(FolderError, match="the environment's table"):
        api.design(spec, set=["design.budget=5000"], out=found.folder, resume=True, by_table=False, **ALLOWED)


def test_an_experiment_tells_how_far_designs_are_below_what_is_possible():
    row = Row(3, mean=-13.13, best=-13.0, fixed=-13.13, seconds=12.0, episodes=880_000)

    assert row.below == pytest.approx(0.01)
    assert row.below_fixed == 0.0
    assert line("cliff", row).split() == [
        "cliff", "3", "-13.1300", "-13.0000", "1.00%", "-13.1300", "0.00%", "880,000", "12"
    ]  # fmt: skip
