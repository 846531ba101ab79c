"""What a design will cost is counted as the run will count it."""

from __future__ import annotations

import json
import re
from dataclasses import asdict, replace
from pathlib import Path

import pytest

from bbsd import api
from bbsd.report.spec.price import price_plain, price_text
from bbsd.runs.pricing.price import price as price_of
from bbsd.solver.paper.settings import settings_of
from tests.unit.compiler.twins import CORRIDOR_OUTSIDE, Corridor
from tests.unit.problems import problem_of

SPEC = Path(__file__).parents[3] / "end_to_end" / "specs" / "thermostat.yaml"


@pytest.fixture(scope="module")
def price():
    return api.price(SPEC, runs=2)


def test_episodes_are_those_of_all_generations_of_all_runs(price):
    design = api.load(SPEC).spec.design
    evolved = design.coevolution
    assert price.episodes == 2 * evolved.generations * evolved.agents * design.learning.episodes


def test_sharing_by_differences_runs_the_last_episodes_again_for_each_behavior_that_evolves(price):
    design = api.load(SPEC).spec.design
    more = api.price(SPEC, runs=2, set=["design.sharing=difference"])
    evolving = sum(table.open_cells > 0 for table in price.tables)
    assert evolving > 0
    agents = 2 * design.coevolution.generations * design.coevolution.agents
    assert more.episodes == price.episodes + agents * design.learning.last * evolving
    assert (
        more.further_episodes == price.further_episodes
    )  # nobody's fitness is shared after the last generation


def test_steps_are_those_of_all_robots_in_all_episodes(price):
    environment = api.load(SPEC).spec.environment
    assert price.steps == (price.episodes + price.further_episodes) * environment.steps * environment.robots


def test_the_search_space_is_that_of_all_tables_and_orders(price):
    tables = sum(table.decades for table in price.tables)
    assert tables <= price.decades
    assert [table.behavior for table in price.tables] == [*api.load(SPEC).spec.behaviors]


def test_time_is_that_of_runs_and_judgement_after_everything_is_compiled(price):
    coevolution = api.load(SPEC).spec.design.coevolution
    lived = (price.episodes + price.further_episodes) * price.microseconds / 1e6
    bred = 2 * coevolution.generations * price.breeding
    assert price.seconds == pytest.approx(price.starting + price.compiling + lived + bred + price.drawing)
    assert price.breeding > 0


def test_runs_side_by_side_take_the_time_of_one_and_the_memory_of_all():
    alone, together = (api.price(SPEC, runs=8, jobs=jobs) for jobs in (1, 8))
    assert (together.episodes, together.steps) == (alone.episodes, alone.steps)
    assert together.bytes > 4 * alone.bytes
    design = api.load(SPEC).spec.design
    judged = design.answer.judged + 10_000 + design.coevolution.agents * design.learning.episodes
    one = (together.episodes + together.further_episodes - judged) / 8
    lived = (one + judged) * together.microseconds / 1e6
    bred = design.coevolution.generations * together.breeding
    assert together.seconds == pytest.approx(together.compiling + lived + bred + together.drawing)


def test_what_came_before_is_added():
    price = api.price(SPEC, starting=1000.0)
    assert price.starting == 1000
    assert 1000 < price.seconds < 2000


def test_nothing_is_written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    api.price(SPEC)
    assert list(tmp_path.iterdir()) == []


def test_it_is_shown_to_people_and_programs(price):
    assert json.loads(json.dumps(price_plain(price))) == json.loads(json.dumps(asdict(price)))
    text = price_text(price)
    assert f"{price.episodes:,} in the generations" in text
    assert all(table.behavior in text for table in price.tables)
    assert price.most_seconds == price.seconds
    assert "\nlength " not in text


def test_what_compiling_takes_is_told_until_it_is_in_the_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("BBSD_CACHE_DIR", str(tmp_path / "cache"))
    first, again = (api.price(SPEC, set=["environment.steps=17"]) for _ in range(2))
    assert first.to_compile > 0.0 == again.to_compile
    assert "by the size of the kernels" in price_text(first)
    assert "compiling     nothing: the kernels are in the cache" in price_text(again)


def test_a_spec_without_holes_has_no_price():
    with pytest.raises(api.NothingToDesign):
        api.price(Path(__file__).parents[4] / "specs" / "object_lifting_hand.yaml")


@pytest.mark.slow
def test_the_memory_of_all_processes_counts_where_python_steps_the_environment():
    text = f"{CORRIDOR_OUTSIDE}\ndesign: {{method: hill, budget: 5000}}\n"
    problem = replace(problem_of(text), stepper=Corridor)
    settings = settings_of(problem.meaning)
    alone, both = (price_of(problem, settings, 0, 1, jobs) for jobs in (1, 2))
    assert alone.most_seconds > alone.seconds
    assert (alone.most_length, price_of(problem, settings, 0, 1, most_steps=7).most_length) == (9, 7)
    text = price_text(replace(alone, seconds=7.0, most_seconds=36.0))
    assert re.search(r"^time +about 7\.0 s to 36\.0 s: ", text, re.MULTILINE)
    assert re.search(r"^length +measured in episodes of [\d.]+ steps.* 9 steps at most", text, re.MULTILINE)
    assert both.bytes > 1.5 * alone.bytes
    assert both.episodes == alone.episodes == 5000
