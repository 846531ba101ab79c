"""The page on the Python API is up to date, says something of every name, and its examples print what it shows."""

import inspect
import re
from pathlib import Path

import pytest

import bbsd
from bbsd import api
from bbsd.report.reference.python import documented, regenerate
from tests.docs.prompts import replayed

PAGE = Path(__file__).parents[2] / "docs" / "api.md"
TEXT = PAGE.read_text(encoding="utf-8")
MARKS = re.findall(r"<!-- generated: ([\w.]+) -->", TEXT)
VERBS = sorted({*bbsd.__all__, "price"} - {"__version__"})
NOTEBOOK = re.findall(r"^```python notebook\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)


def test_generated_parts_are_up_to_date(request):
    text = PAGE.read_text(encoding="utf-8")
    if request.config.getoption("--update-golden"):
        PAGE.write_text(regenerate(text), encoding="utf-8", newline="\n")
    else:
        assert regenerate(text) == text


@pytest.mark.parametrize("name", VERBS)
def test_every_verb_has_a_part_and_an_example(name):
    part = re.search(rf"^### {name}\n.*?(?=^##)", TEXT, re.MULTILINE | re.DOTALL)[0]
    assert f"<!-- generated: {name} -->" in part
    assert re.search(rf"^>>> .*\b{name}\(", part, re.MULTILINE) or re.search(
        rf"\b{name}\(", part.split("pycon")[1]
    )


@pytest.mark.parametrize("name", VERBS)
def test_every_argument_and_error_of_a_verb_is_documented(name):
    verb = getattr(api, name)
    found = documented(verb.__init__ if inspect.isclass(verb) else verb)
    assert list(found.arguments) == list(inspect.signature(verb).parameters)
    assert found.errors


@pytest.mark.slow
def test_examples_print_what_the_page_shows(tmp_path, request):
    (tmp_path / "specs").symlink_to(PAGE.parents[1] / "specs")
    text = PAGE.read_text(encoding="utf-8")
    now = replayed(text, tmp_path)
    if request.config.getoption("--update-golden"):
        PAGE.write_text(now, encoding="utf-8", newline="\n")
    else:
        assert now == text


@pytest.mark.slow
def test_cells_of_the_notebook_show_tables_progress_and_curves(tmp_path, monkeypatch, capsys):
    pytest.importorskip("IPython")
    matplotlib = pytest.importorskip("matplotlib")
    from IPython.core.interactiveshell import InteractiveShell

    monkeypatch.setattr(InteractiveShell, "_instance", None)
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path / "ipython"))
    (tmp_path / "specs").symlink_to(PAGE.parents[1] / "specs")
    monkeypatch.chdir(tmp_path)
    matplotlib.use("agg")
    shell = InteractiveShell.instance()
    shown = []
    try:
        for cell in NOTEBOOK:
            ran = shell.run_cell(cell, store_history=False)
            ran.raise_error()
            shown.append(shell.display_formatter.format(ran.result)[0])
    finally:
        InteractiveShell.clear_instance()
    tables, curves = shown[:-2], shown[-2:]
    assert all(re.match("<(p|table|pre)>", each["text/html"]) for each in tables)
    assert all("Axes" in each["text/plain"] for each in curves)
    progress = re.findall(
        r"^run 1/1, ([\d,]+) of 20,000 episodes: best so far", capsys.readouterr().out, re.MULTILINE
    )
    assert progress
    assert progress[-1] == "20,000"
