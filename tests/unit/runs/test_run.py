import json
from itertools import islice

import pytest

from bbsd.runs.run import generations, run_key, start
from bbsd.runs.storage import checkpoint
from bbsd.runs.storage.state import restored_run, run_arrays
from bbsd.solver.judgement import judge
from bbsd.solver.paper.settings import settings_of
from tests.unit.problems import RICH, problem_of
from tests.unit.runs.commands import WHO
from tests.unit.solver.problems import guess

SEED, N_RUNS = 11, 2


def whole(problem, settings, path, n_runs=N_RUNS, at=None):
    """All runs from start to end: their metrics, the last one's last state's bytes, and how they are judged.

    With `at`, the state is written down and read back after so many generations or answers.
    """
    answers, lines = [], []
    for run in range(n_runs):
        reached = start(problem, settings, SEED, run)
        while reached.answer is None:
            for progress, line in generations(reached, problem, settings, SEED):
                lines.append(json.dumps(line))
                checkpoint.save(path, WHO, run_arrays(progress))
                reached = progress
                if len(lines) == at:
                    fresh = start(problem, settings, SEED, run)
                    reached = restored_run(
                        checkpoint.load(path, WHO), fresh, problem
                    )  # what a resumed command goes on from
                    break
        answers.append(reached.answer)
    return lines, path.read_bytes(), judged(judge(answers, problem, settings, SEED))


def judged(judgement):
    tables = [table.tolist() for table in judgement.architecture.tables]
    structure = judgement.architecture.structure.tolist()
    return tables, structure, judgement.evaluation, judgement.lifetime, judgement.random


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory):
    return whole(*guess(lanes=5), tmp_path_factory.mktemp("run") / "c")


@pytest.mark.slow
@pytest.mark.parametrize("at", range(1, 11))
def test_resuming_after_any_generation_changes_no_bit(at, uninterrupted, tmp_path):
    assert whole(*guess(lanes=5), tmp_path / "c", at=at) == uninterrupted


@pytest.mark.parametrize("lanes", [1, 16, 40])
def test_any_number_of_lanes_gives_the_same_bits(lanes, uninterrupted, tmp_path):
    assert whole(*guess(lanes=lanes), tmp_path / "c") == uninterrupted


def test_several_robots_with_an_end_and_draws_give_the_same_bits_on_any_lanes():
    told = []
    for lanes in (3, 16):
        problem = problem_of(RICH, lanes=lanes)
        settings = settings_of(problem.meaning)
        steps = generations(start(problem, settings, SEED, 0), problem, settings, SEED)
        told.append([line for _, line in islice(steps, settings.coevolution.generations)])
    assert told[0] == told[1]


def test_every_generation_has_its_line_and_every_run_its_answer(uninterrupted):
    lines = [json.loads(line) for line in uninterrupted[0]]
    told = [line and (line["run"], line["generation"]) for line in lines]
    assert told == [(1, 1), (1, 2), (1, 3), (1, 4), None, (2, 1), (2, 2), (2, 3), (2, 4), None]


def test_runs_are_different_and_more_runs_begin_with_the_same(uninterrupted, tmp_path):
    one = whole(*guess(lanes=5), tmp_path / "c", n_runs=1)
    assert uninterrupted[0][:5] == one[0]
    assert json.loads(uninterrupted[0][5])["mean"] != json.loads(uninterrupted[0][0])["mean"]
    assert run_key(SEED, 0) != run_key(SEED, 1)
    assert run_key(SEED, 0) != run_key(SEED + 1, 0)


def test_a_design_is_judged_on_fresh_episodes_and_is_better_than_random(uninterrupted):
    _, structure, evaluated, lifetime, random = uninterrupted[2]
    assert sorted(structure) == [0, 1, 2]
    assert evaluated.episodes == 100
    assert evaluated.mean > random.high
    assert (lifetime.count, random.count) == (12, 1000)
    assert lifetime.mean <= evaluated.mean + 0.5


def test_a_given_structure_is_designed_and_judged_without_a_culture(tmp_path):
    _, _, (tables, structure, evaluated, lifetime, _) = whole(
        *guess("structure: [even, odd]"), tmp_path / "c", n_runs=1
    )
    assert structure == [0, 1]
    assert tables[1][2] == 2  # given
    assert lifetime.mean == pytest.approx(evaluated.mean, abs=0.7)
