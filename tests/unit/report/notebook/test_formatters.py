import importlib
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest

import bbsd
from bbsd.api import explain
from bbsd.evaluation import evaluation_keys
from bbsd.report.notebook.formatters import FORMATTERS, register
from bbsd.runs.storage.watching import Watched, WatchedRun
from tests.unit.explanation.comparison.designs import HAND, WALK, compared_designs, design_of, edited
from tests.unit.report.notebook.test_html import Reader
from tests.unit.report.watching.test_events import SEARCH


@pytest.fixture
def shell():
    """What IPython calls formatters by, without a terminal."""
    pytest.importorskip("IPython")
    from IPython.core.formatters import DisplayFormatter

    made = SimpleNamespace(display_formatter=DisplayFormatter())
    register(made)
    return made


def shown(shell, value):
    data, _ = shell.display_formatter.format(value)
    Reader(data["text/html"])
    return data["text/html"], data["text/plain"]


@pytest.mark.parametrize("place", FORMATTERS)
def test_the_types_are_where_they_are_looked_for(place):
    module, _, name = place.rpartition(".")
    assert getattr(importlib.import_module(module), name).__module__ == module


def test_evaluations_and_designs_are_tables(shell, evaluation, designed):
    nasty = replace(evaluation, reward_terms={"<b>bold</b>": 1.0})
    page, plain = shown(shell, nasty)
    assert "<table>" in page
    assert "&lt;b&gt;bold" in page
    assert plain == "<Evaluation: mean return 301.373 (300.938 to 301.809) in 1,000 episodes>"
    page, plain = shown(shell, designed)
    assert "stop_at_goal" in page
    assert len(plain) < 200


def test_a_trace_shows_its_first_and_last_steps(shell, trace):
    page, plain = shown(shell, trace)
    assert page.count("<tr>") == 1 + 1 + len(trace.steps)
    assert plain == "<Trace of 3 steps, 2 robots, return 0.95>"


def test_a_long_trace_is_cut_in_the_middle(shell):
    from bbsd.evaluation import trace as traced

    design = design_of(WALK.replace("steps: 6", "steps: 60"))
    page, _ = shown(shell, traced(design.problem, design.architecture, 3, 1))
    assert page.count("<tr>") == 1 + 5 + 1 + 5
    assert "⋮" in page


def test_explanations_and_comparisons(shell, tmp_path):
    (tmp_path / "hand.yaml").write_text(HAND)
    page, plain = shown(shell, explain(tmp_path / "hand.yaml"))
    assert page.startswith("<pre>")
    assert "stop_at_goal" in plain
    other = edited(WALK, ("do: left}", "do: no action}"))
    comparison = compared_designs(
        design_of(WALK, "a.yaml"), design_of(other, "b.yaml"), evaluation_keys(0, 5)
    )
    page, plain = shown(shell, comparison)
    assert "left by back; right by go<br>where far" in page
    assert plain.startswith("<Comparison: b.yaml earns +")


def test_a_run_that_is_watched(shell):
    run = WatchedRun(1, "", tuple(SEARCH))
    page, plain = shown(shell, Watched(Path("runs/x"), "running", 1, 400, (run,), {}))
    assert "<p>runs/x is running</p>" in page
    assert plain == "<Watched runs/x: running, 1 of 1 runs>"


def test_a_loaded_spec_is_short():
    assert repr(design_of(WALK).loaded) == "<Loaded spec.yaml: walk>"


def test_formatters_are_registered_when_a_function_is_first_used_in_a_notebook(monkeypatch, shell):
    shell.display_formatter.formatters["text/html"].deferred_printers.clear()
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell))
    assert bbsd.evaluate
    assert ("bbsd.evaluation.tracing.traced", "Trace") in shell.display_formatter.formatters[
        "text/html"
    ].deferred_printers


def test_nothing_is_registered_without_a_running_shell(monkeypatch):
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: None))
    assert bbsd.evaluate
