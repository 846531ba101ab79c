import json
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

import bbsd.api
from bbsd.architecture import HolesLeft
from bbsd.errors import SpecError, UsageError
from bbsd.evaluation import NotEnumerable
from bbsd.runs.storage.folder import FolderError
from bbsd.version import REVISION

SPEC = Path(__file__).parents[2] / "end_to_end" / "specs" / "thermostat.yaml"
SEED = 2
EXACT = """
bbsd: 1
name: exact
environment: {steps: 1, state: {x: "integers(1, 4)", y: 0}}
behaviors:
  low: {inputs: {low: x < 3}, actions: {say: {y: 1}}, rules: [{when: {low: true}, do: say}, otherwise: no action]}
structure: [low]
reward: {right: "x if y == 1 else 0"}
"""
"""Of the starts 1, 2, 3 and 4, the first two earn a reward."""


MODELINE = "# yaml-language-server: $schema=../schema/bbsd.schema.json\n"


@pytest.fixture(scope="module")
def designed(tmp_path_factory):
    """A design of two runs, and its progress."""
    reports = []
    out = tmp_path_factory.mktemp("api") / "run"
    return bbsd.api.design(SPEC, seed=SEED, runs=2, out=out, progress=reports.append), reports


@pytest.fixture
def spec(tmp_path):
    """Write a spec and return its path."""

    def write(text):
        path = tmp_path / "spec.yaml"
        path.write_text(text)
        return path

    return write


def files(folder):
    return [(folder / name).read_bytes() for name in ("architecture.yaml", "metrics.jsonl", "spec.yaml")]


def test_a_design_is_written_beside_what_it_came_from(designed):
    found, _ = designed
    assert found.architecture == found.folder / "architecture.yaml"
    assert (found.folder / "spec.yaml").read_text() == SPEC.read_text()
    note = json.loads((found.folder / "run.json").read_text())
    assert (note["seed"], note["runs"], note["set"]) == (SEED, 2, [])
    assert note["result"]["return"]["mean"] == found.mean
    assert sorted(found.structure) == ["heat", "save"]


def test_what_was_designed_has_no_holes_and_earns_what_was_said(designed):
    found, _ = designed
    again = bbsd.api.evaluate(found.architecture, episodes=2000)
    assert again.mean == pytest.approx(found.mean, abs=4 * found.sd / found.episodes**0.5)
    assert found.ci95[0] < found.mean < found.ci95[1]
    assert found.mean > found.random.high
    with pytest.raises(bbsd.api.NothingToDesign, match="no holes"):
        bbsd.api.design(found.architecture, out=found.folder / "again")
    assert not (found.folder / "again").exists()


@pytest.mark.slow
def test_a_design_that_could_not_be_written_is_refused_before_any_work(spec, tmp_path):
    large = spec(
        EXACT.replace("low: x < 3", "low: 'values(x, 0, 999998)'").replace(
            ", rules: [{when: {low: true}, do: say}, otherwise: no action]", ""
        )
    )
    with pytest.raises(SpecError) as caught:
        bbsd.api.design(large, out=tmp_path / "run")
    assert [each.code for each in caught.value.diagnoses] == ["BB048"]
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize(
    ("overrides", "kept"),
    [
        (["view=null"], False),
        (["view.at=[warmth, 0]", "view=null"], False),
        (["view=null", "view.at=[warmth, 0]"], True),
    ],
)
def test_what_is_set_to_nothing_is_not_in_the_design(overrides, kept, tmp_path):
    found = bbsd.api.design(SPEC, out=tmp_path / "run", set=overrides)
    assert ("view:" in found.architecture.read_text()) is kept


def test_progress_is_told_after_every_generation(designed):
    _, reports = designed
    assert [(report.run, report.generation) for report in reports] == [
        (run, g) for run in (1, 2) for g in (1, 2, 3, 4)
    ]
    assert {(report.runs, report.generations) for report in reports} == {(2, 4)}
    assert all(report.mean <= report.best for report in reports)


def test_the_same_command_writes_the_same_bytes(designed, tmp_path):
    found, _ = designed
    again = bbsd.api.design(SPEC, seed=SEED, runs=2, out=tmp_path / "run")
    assert files(again.folder) == files(found.folder)
    assert again.evaluation == found.evaluation


@pytest.mark.parametrize("at", [1, 4, 6])
def test_a_stopped_design_goes_on_to_the_same_bytes(designed, tmp_path, at):
    found, _ = designed
    reports = []

    def stop(progress):
        reports.append(progress)
        if len(reports) == at:
            raise KeyboardInterrupt

    with pytest.raises(bbsd.api.Interrupted) as stopped:
        bbsd.api.design(SPEC, seed=SEED, runs=2, out=tmp_path / "run", progress=stop)
    assert stopped.value.folder == tmp_path / "run"
    assert not (tmp_path / "run" / "architecture.yaml").exists()
    again = bbsd.api.design(
        SPEC, seed=SEED, runs=2, out=tmp_path / "run", resume=True, progress=reports.append
    )
    assert len(reports) == 8
    assert files(again.folder) == files(found.folder)


def test_a_design_is_resumed_only_where_it_is_the_same(designed):
    found, _ = designed
    before = files(found.folder)
    for changed in ({"seed": 3}, {"runs": 1}, {"set": ["environment.steps=3"]}):
        with pytest.raises(FolderError, match="holds no run of this spec"):
            bbsd.api.design(SPEC, **{"seed": SEED, "runs": 2, **changed}, out=found.folder, resume=True)
    with pytest.raises(FolderError, match="nothing is overwritten"):
        bbsd.api.design(SPEC, seed=SEED, runs=2, out=found.folder)
    assert files(found.folder) == before


def test_a_folder_of_another_revision_is_not_resumed(tmp_path):
    def stop(_progress):
        raise KeyboardInterrupt

    with pytest.raises(bbsd.api.Interrupted):
        bbsd.api.design(SPEC, out=tmp_path / "run", progress=stop)
    path = tmp_path / "run" / "run.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | {"revision": REVISION + 1}))
    before = path.read_bytes(), (tmp_path / "run" / "checkpoint.npz").read_bytes()
    with pytest.raises(
        FolderError, match=rf"by bbsd {bbsd.__version__}, revision {REVISION + 1}; this is bbsd"
    ):
        bbsd.api.design(SPEC, out=tmp_path / "run", resume=True)
    assert before == (path.read_bytes(), (tmp_path / "run" / "checkpoint.npz").read_bytes())


def test_a_spec_with_holes_is_not_evaluated_but_by_random_agents():
    with pytest.raises(HolesLeft, match="heat: 3 of 3 cells open; 2 of 2 layers open"):
        bbsd.api.evaluate(SPEC)
    random = bbsd.api.evaluate(SPEC, fill="random", agents=50, episodes=4)
    assert (random.agents, random.episodes) == (50, 200)


def test_random_agents_live_ten_episodes_each_and_a_design_a_thousand(designed):
    random = bbsd.api.evaluate(SPEC, fill="random", agents=50)
    assert random.episodes == 500
    assert bbsd.api.evaluate(designed[0].architecture).episodes == 1000


def test_an_evaluation_tells_how_far_it_is(designed):
    reports = []
    found = bbsd.api.evaluate(
        designed[0].architecture, episodes=9000, progress=lambda *figures: reports.append(figures)
    )
    assert reports == [(4000, 9000), (8000, 9000), (9000, 9000)]
    assert found == bbsd.api.evaluate(designed[0].architecture, episodes=9000)


def test_what_is_designed_keeps_its_view(spec):
    path = spec(EXACT.replace("rules: [{when: {low: true}, do: say}, otherwise: no action]", "rules: null"))
    text = path.read_text() + "view:   # from above\n  at: [x, y]   # both\n  marks: {one: [1, 1]}\n"
    path.write_text(text + "design: {coevolution: {generations: 2, population: 4, agents: 8}}\n")
    found = bbsd.api.design(path, out=path.parent / "run")
    assert (
        "view:   # from above\n  at: [x, y]   # both\n  marks: {one: [1, 1]}\n"
        in found.architecture.read_text()
    )
    assert bbsd.api.trace(found.architecture).scene.marks["one"].tolist() == [[1, 1], [1, 1]]


def test_an_evaluation_is_the_same_for_the_same_seed_only(designed):
    path = designed[0].architecture
    first, again, other = (bbsd.api.evaluate(path, episodes=100, seed=seed) for seed in (1, 1, 2))
    assert first == again
    assert first != other


def test_a_trace_is_an_episode_that_was_evaluated(designed):
    path = designed[0].architecture
    earned = []
    for episode in range(3):
        rewards = bbsd.api.trace(path, seed=1, episode=episode).rewards
        earned.append(sum(float(values.sum()) for [values] in rewards.values()))
    means = [bbsd.api.evaluate(path, seed=1, episodes=episodes).mean for episodes in (1, 2, 3)]
    assert means == pytest.approx([sum(earned[:count]) / count for count in (1, 2, 3)])
    assert len({*means}) > 1 or all(a == b for a, b in pairwise(earned))


@pytest.mark.parametrize("rank", ["worst", "median", "best"])
def test_a_trace_can_be_of_an_episode_chosen_by_its_return(designed, rank):
    path = designed[0].architecture
    spread = bbsd.api.evaluate(path, seed=1, episodes=40).spread
    chosen = bbsd.api.trace(path, seed=1, episode=rank, episodes=40)
    named = bbsd.api.trace(path, seed=1, episode=spread.episodes[rank])
    assert chosen.values == named.values
    why = bbsd.api.why(path, seed=1, episode=spread.episodes[rank], step=2)
    assert (why.behavior, why.episode) == (chosen.controlling[0][1], spread.episodes[rank])


def test_no_episode_is_before_the_first(designed):
    with pytest.raises(UsageError, match="episode is a whole number of 0 or more, not -1"):
        bbsd.api.trace(designed[0].architecture, episode=-1)


def test_an_exact_evaluation_tries_every_start(spec):
    found = bbsd.api.evaluate(spec(EXACT), exact=True)
    assert (found.mean, found.episodes, found.exact) == (0.75, 4, True)


def test_an_exact_evaluation_of_what_cannot_be_enumerated_is_refused(spec):
    with pytest.raises(NotEnumerable, match="uniform"):
        bbsd.api.evaluate(spec(EXACT.replace("integers(1, 4)", "uniform(1, 4)")), exact=True)


@pytest.mark.parametrize(
    ("reward", "line", "message"),
    [
        ("{fine: 1, right: 1 / (step - 1)}", 7, "reward term right was inf in step 1 for robot 0"),
        ("{right: 1e308, more: 1e308}", 7, "the sum of all rewards was inf in step 1"),
    ],
)
def test_a_reward_that_is_not_finite_is_told_at_its_place(spec, reward, line, message):
    path = spec(EXACT.partition("reward:")[0].strip() + f"\nreward: {reward}\n")
    with pytest.raises(SpecError) as error:
        bbsd.api.evaluate(path, episodes=1)
    [diagnosis] = error.value.diagnoses
    assert diagnosis.code == "BB045"
    assert message in diagnosis.message
    assert diagnosis.place.line == line


def test_the_kernel_that_is_printed_is_the_one_that_runs():
    source = bbsd.api.compile(SPEC, lanes=8)
    assert "def rollout(" in source
    assert "def rollout_detailed(" in source
    lifting = Path(__file__).parents[3] / "specs" / "object_lifting.yaml"
    assert bbsd.api.compile(lifting).count("atan(") == 3  # at the start, and in steps where the tilt is told


def test_mistakes_are_found_without_an_error(spec):
    assert bbsd.api.check(SPEC) == ()
    assert [each.code for each in bbsd.api.check(spec(EXACT.replace("steps: 1", "stesp: 1")))] != []


def test_overrides_change_what_is_evaluated(spec):
    path = spec(EXACT)
    assert bbsd.api.evaluate(path, exact=True, set=["environment.state.x=2"]).mean == 2
    assert bbsd.api.load(path, set=["environment.steps=7"]).spec.environment.steps == 7


def test_a_loaded_spec_is_taken_as_it_is(spec):
    loaded = bbsd.api.load(spec(EXACT))
    assert bbsd.api.load(loaded) is loaded
    assert bbsd.api.evaluate(loaded, exact=True).mean == 0.75


def test_overrides_of_a_loaded_spec_are_used_and_recorded(tmp_path):
    loaded = bbsd.api.load(SPEC, set=["environment.steps=4"])
    found = bbsd.api.design(loaded, seed=3, out=tmp_path / "run", set=["environment.state.heating=1"])
    note = json.loads((found.folder / "run.json").read_text())
    assert (note["seed"], note["set"]) == (3, ["environment.steps=4", "environment.state.heating=1"])
    again = bbsd.api.load(found.architecture)
    assert (again.spec.environment.steps, again.data["environment"]["state"]["heating"]) == (4, 1)
    text = bbsd.api.design(
        SPEC, seed=3, out=tmp_path / "text", set=["environment.steps=4", "environment.state.heating=1"]
    )
    assert files(text.folder)[:2] == files(found.folder)[:2]


def test_draws_in_constants_of_a_loaded_spec_are_those_of_the_design_s_seed(spec, tmp_path):
    path = spec(SPEC.read_text() + "\nconstants: {odd: 'uniform(0, 1)'}\n")
    one = bbsd.api.design(bbsd.api.load(path), seed=3, out=tmp_path / "one")
    other = bbsd.api.design(path, seed=3, out=tmp_path / "other")
    assert files(one.folder) == files(other.folder)


def test_an_explanation_needs_a_design(designed):
    with pytest.raises(HolesLeft):
        bbsd.api.explain(SPEC)
    assert bbsd.api.explain(designed[0].architecture) is not None


def test_a_run_stands_for_its_design(designed):
    found, _ = designed
    assert bbsd.api.load(found.folder).data == bbsd.api.load(found.architecture).data
    by_folder, by_file = (
        bbsd.api.evaluate(each, episodes=5) for each in (str(found.folder), found.architecture)
    )
    assert by_folder.mean == by_file.mean


def test_what_needs_no_compiler_imports_none(designed):
    program = f"import sys, bbsd\nbbsd.explain({str(designed[0].folder)!r})\nsys.exit('numba' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


def test_a_design_leads_no_editor_to_a_schema_that_is_not_there(designed, tmp_path):
    spec = tmp_path / "spec.yaml"
    spec.write_text(MODELINE + SPEC.read_text())
    found = bbsd.api.design(spec, seed=SEED, runs=2, out=tmp_path / "run")
    assert found.architecture.read_bytes() == designed[0].architecture.read_bytes()
    assert (found.folder / "spec.yaml").read_text() == spec.read_text()
