"""The command line as a shell sees it: what is on which stream, and with which code it leaves."""

from __future__ import annotations

import ast
import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from bbsd import __version__
from tests.end_to_end.commands import bbsd, process

SPEC = Path(__file__).parent / "specs" / "thermostat.yaml"
HEAVY = ("numba", "numpy", "pydantic", "yaml", "rich", "matplotlib")
LATE = (
    "bbsd.api.results",
    "bbsd.cli.designing",
    "bbsd.compiler",
    "bbsd.errors.catalog",
    "bbsd.evaluation",
    "bbsd.language.meant",
    "bbsd.language.overrides",
    "bbsd.language.recovery",
    "bbsd.report.plain",
    "bbsd.runs.storage",
    "bbsd.solver",
    "bbsd.text.reading.syntax",
    "bbsd.text.writing",
)
"""What a check of a spec without mistakes does without."""
COMMANDS = ("design", "evaluate", "explain", "why", "check", "config", "compile")


@pytest.fixture(scope="module")
def designed(tmp_path_factory):
    """A folder that `bbsd design` wrote, and what it said."""
    folder = tmp_path_factory.mktemp("designed")
    return folder, bbsd("design", SPEC, "--plot", "--out", folder)


def keys(text):
    return list(json.loads(text))


def modules_imported(*words):
    """Return the names of all modules that a command imports, in a process of its own."""
    command = [sys.executable, "-X", "importtime", "-m", "bbsd", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return {line.rpartition("|")[2].strip() for line in done.stderr.splitlines()}


def test_help_lists_the_commands():
    code, out, err = bbsd("--help")
    assert (code, err) == (0, "")
    for command in COMMANDS:
        assert f"  {command} " in out


@pytest.mark.parametrize(
    ("words", "heavy"),
    [(["--help"], HEAVY), (["--version"], HEAVY), (["design", "--help"], {*HEAVY} - {"pydantic"})],
)
def test_help_imports_nothing_heavy(words, heavy):
    """But for pydantic, which typer itself needs for a command's options."""
    imported = modules_imported(*words)
    assert "bbsd" in imported
    assert not {name.partition(".")[0] for name in imported} & {*heavy}


def test_help_imports_neither_commands_nor_the_language():
    packages = {".".join(name.split(".")[:2]) for name in modules_imported("--help")}
    assert {each for each in packages if each.startswith("bbsd.")} <= {
        "bbsd.cli",
        "bbsd.errors",
        "bbsd.version",
    }


def test_a_check_imports_only_what_it_uses():
    imported = modules_imported("check", SPEC)
    assert "bbsd.language.warnings.finding" in imported
    assert not {name.partition(".")[0] for name in imported} & ({*HEAVY} - {"pydantic", "yaml"})
    assert not {name for name in imported if name.startswith(LATE)}


def test_no_plugin_of_pydantic_is_imported(tmp_path, monkeypatch):
    monkeypatch.delenv("PYDANTIC_DISABLE_PLUGINS", raising=False)
    known = tmp_path / "planted-1.0.dist-info"
    known.mkdir()
    (known / "METADATA").write_text("Metadata-Version: 2.1\nName: planted\nVersion: 1.0\n")
    (known / "entry_points.txt").write_text("[pydantic]\nplanted = planted:plugin\n")
    (tmp_path / "planted.py").write_text("print('planted')\nplugin = None\n")
    program = [sys.executable, "-c", "from bbsd.language.models import Spec; Spec.model_rebuild(force=True)"]
    command = [sys.executable, "-m", "bbsd", "check", str(SPEC)]
    path = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
    said = [
        subprocess.run(
            words, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, check=False
        ).stdout
        for words in (program, command)
    ]
    assert "planted" in said[0]
    assert "planted" not in said[1]


def test_the_version_is_the_package_s():
    assert bbsd("--version") == (0, f"bbsd {__version__}\n", "")


@pytest.mark.parametrize(
    "words",
    [
        ["desing"],
        ["design"],
        ["design", SPEC, "--sed", "1"],
        ["design", SPEC, "--seed", "one"],
        ["design", SPEC, "--runs", "0"],
        ["evaluate", SPEC, "--fill", "ones"],
        ["evaluate", SPEC, "--fill", "random", "--exact"],
        ["check"],
        ["check", "--describe", "BB999"],
    ],
)
def test_a_wrong_word_on_the_command_line_is_explained(words):
    code, out, err = bbsd(*words)
    assert (code, out) == (2, "")
    assert "Error: " in err


@pytest.mark.parametrize("command", COMMANDS)
def test_a_file_that_is_not_there_is_a_mistake_in_any_command(command, tmp_path):
    code, out, err = bbsd(command, "nowhere.yaml", cwd=tmp_path)
    assert code == 2
    assert "nowhere.yaml: error[BB001]: there is no such file" in (out if command == "check" else err)


def test_a_spec_without_mistakes_is_sized_up():
    expected = f"{SPEC}: ok (2 behaviors, 3 open cells, 2 open layers, search space 10^1.7)\n"
    expected += "  open: all cells of heat; the structure (2 layers)\n"
    assert bbsd("check", SPEC) == (0, expected, "")


@pytest.fixture
def mistaken(tmp_path):
    path = tmp_path / "mistaken.yaml"
    path.write_text(SPEC.read_text().replace("steps: 20", "stepz: 20").replace("warmth > 25", "warmht > 25"))
    return path


def test_all_mistakes_of_all_files_are_shown_with_their_lines(mistaken):
    code, out, err = bbsd("check", mistaken, SPEC)
    assert (code, err) == (2, "")
    assert 'did you mean "steps"?' in out
    assert "    6 |   stepz: 20\n      |   ^^^^^\n" in out
    assert f" mistakes in {mistaken}\n" in out
    assert f"{SPEC}: ok (" in out


def test_mistakes_as_json(mistaken):
    code, out, err = bbsd("check", mistaken, "--format", "json")
    assert (code, err) == (2, "")
    found = json.loads(out)
    keys_of_each = ["file", "line", "column", "end_column", "code", "severity", "message", "advice"]
    assert [*found["diagnoses"][0]][:8] == keys_of_each
    (spec,) = found["specs"]
    assert (spec["file"], spec["mistakes"], spec["warnings"]) == (str(mistaken), len(found["diagnoses"]), 0)
    code, out, err = bbsd("check", SPEC, "--format", "json")
    assert (code, json.loads(out)["diagnoses"], err) == (0, [], "")


def test_other_commands_tell_mistakes_on_standard_error(mistaken):
    code, out, err = bbsd("compile", mistaken)
    assert (code, out) == (2, "")
    assert 'did you mean "steps"?' in err


def test_a_kind_of_mistake_is_described_in_either_case():
    code, out, err = bbsd("check", "--describe", "bb006")
    assert (code, err) == (0, "")
    assert out.startswith("BB006: a key given twice\n")


def test_a_configuration_is_a_spec_that_says_where_its_values_come_from(tmp_path):
    code, out, err = bbsd("config", SPEC.name, "--set", "design.learning.last=2", cwd=SPEC.parent)
    assert (code, err) == (0, "")
    notes = {
        line.split("#")[0].strip(): line.split("#")[-1].strip() for line in out.splitlines() if "#" in line
    }
    assert notes["steps: 20"] == "thermostat.yaml:6"
    assert notes["last: 2"] == "--set"
    assert notes["tournament: 3"] == "default"
    (tmp_path / "whole.yaml").write_text(out)
    assert bbsd("check", "whole.yaml", cwd=tmp_path)[0] == 0


def test_a_mistake_in_an_override_is_shown_there():
    code, out, err = bbsd("config", SPEC, "--set", "environment.stepz=5")
    assert (code, out) == (2, "")
    assert err.startswith("--set:1:13: error[")


def test_a_compiled_kernel_is_python():
    code, out, err = bbsd("compile", SPEC)
    assert (code, err) == (0, "")
    assert any(isinstance(node, ast.FunctionDef) for node in ast.parse(out).body)


def test_a_design_is_a_folder_with_a_table_for_its_reader(designed):
    folder, (code, out, err) = designed
    assert code == 0
    assert {"architecture.yaml", "metrics.jsonl", "run.json", "spec.yaml", "curves.png"} <= {
        path.name for path in folder.iterdir()
    }
    assert [line.split()[0] for line in out.splitlines() if line][-4:-1] == ["design", "lifetime", "random"]
    note, *lines = err.splitlines()
    assert "names no method, so it is designed by the paper's loop" in note
    assert [line.partition(":")[0] for line in lines] == [f"generation {g}/4" for g in (1, 2, 3, 4)]


def test_a_design_is_the_same_in_another_process(designed, tmp_path):
    with process("design", SPEC, "--plot", "--out", tmp_path / "again", "--json", "--quiet") as running:
        out, err = running.communicate()
    assert (running.returncode, err) == (0, "")
    result = json.loads(out)
    assert [*result] == [
        *("architecture", "return", "episodes", "lifetime", "random", "method"),
        *("structure", "seconds", "compile_seconds", "seed", "runs", "search_episodes"),
    ]
    for name in ("architecture.yaml", "metrics.jsonl", "curves.png"):
        assert (tmp_path / "again" / name).read_bytes() == (designed[0] / name).read_bytes()


def test_curves_are_drawn_only_when_asked_for(designed, tmp_path):
    folder = tmp_path / "run"
    assert bbsd("design", SPEC, "--out", folder, "--quiet")[0] == 0
    assert not (folder / "curves.png").exists()
    code, out, _ = bbsd("design", SPEC, "--out", folder, "--quiet", "--resume", "--plot")
    assert code == 0
    assert "mean return" in out
    assert (folder / "curves.png").read_bytes() == (designed[0] / "curves.png").read_bytes()


def test_a_run_s_folder_is_not_overwritten(designed):
    code, out, err = bbsd("design", SPEC, "--out", designed[0])
    assert (code, out) == (2, "")
    assert "--resume" in err


def test_a_folder_that_cannot_be_made_is_found_before_the_run(tmp_path):
    (tmp_path / "file").write_text("")
    code, out, err = bbsd("design", SPEC, "--out", tmp_path / "file" / "run")
    assert (code, out) == (2, "")
    assert "cannot be made" in err
    assert "generation" not in err


def test_nothing_is_left_to_design_in_a_design(designed, tmp_path):
    code, out, err = bbsd("design", designed[0] / "architecture.yaml", "--out", tmp_path / "run")
    assert (code, out) == (2, "")
    assert "no holes" in err


def test_a_stopped_design_says_how_to_go_on(tmp_path):
    words = [
        "design",
        str(SPEC),
        "--set",
        "design.coevolution.generations=500",
        "--set",
        "design.method=paper",
    ]
    with process(*words, cwd=tmp_path) as running:
        first = running.stderr.readline()
        running.send_signal(signal.SIGINT)
        out, err = running.communicate()
    assert first.startswith("generation 50/500")
    assert (running.returncode, out) == (130, "")
    resumed = ["bbsd", *words, "--out", "runs/thermostat-seed0", "--resume"]
    assert err.splitlines()[-1].endswith("To continue: " + " ".join(resumed))
    code, out, err = bbsd(*resumed[1:], cwd=tmp_path)
    assert code == 0
    assert "generation 500/500" in err
    assert "generation 50/500" not in err


def test_an_evaluation_for_programs(designed):
    code, out, err = bbsd("evaluate", designed[0] / "architecture.yaml", "--episodes", 50, "--json")
    assert (code, err) == (0, "")
    result = json.loads(out)
    assert [*result] == [
        *("return", "episodes", "agents", "exact", "steps", "reward_terms", "control_share", "spread")
    ]
    assert [*result["return"]] == ["mean", "sd", "ci95"]
    assert [*result["reward_terms"]] == ["comfort", "gas"]
    assert [*result["control_share"]] == ["heat", "save", "nobody"]
    assert sum(result["reward_terms"].values()) == pytest.approx(result["return"]["mean"])
    assert sum(result["control_share"].values()) == pytest.approx(1)


def test_an_evaluation_for_people(designed):
    code, out, err = bbsd("evaluate", designed[0] / "architecture.yaml", "--episodes", 5)
    assert (code, err) == (0, "")
    assert "5 episodes of 20 steps" in out
    assert "█" in out


def test_an_output_without_block_characters_has_ascii_bars(designed):
    code, out, _ = bbsd("evaluate", designed[0] / "architecture.yaml", "--episodes", 5, encoding="ascii")
    assert code == 0
    assert "####" in out
    assert out.isascii()


@pytest.mark.parametrize(("bound", "code"), [(-100, 0), (100, 1)])
def test_a_design_can_be_held_to_a_bound(designed, bound, code):
    found, out, err = bbsd(
        "evaluate", designed[0] / "architecture.yaml", "--episodes", 5, "--at-least", bound
    )
    assert found == code
    assert out.startswith("return ")
    assert ("is below 100.00 by" in err) == bool(code)


EXPECTING = """
bbsd: 1
name: expecting
environment: {steps: 4, state: {x: 0}}
behaviors:
  climb: {actions: {up: {x: x + step}}, rules: [otherwise: up], expects: x < 5}
  fall: {actions: {down: {x: x - 1}}, rules: [otherwise: down], expects: x < before(x)}
structure: [climb]
design: {layers: 1}
reward: {high: x}
"""
"""After the four steps x is 1, 3, 6, 10; fall never controls."""


@pytest.mark.parametrize(("share", "code"), [(0.5, 0), (0.51, 1)])
def test_a_design_can_be_held_to_its_expectations(tmp_path, share, code):
    spec = tmp_path / "expecting.yaml"
    spec.write_text(EXPECTING)
    found, out, err = bbsd("evaluate", spec, "--episodes", 3, "--expect-at-least", share)
    assert found == code
    assert "climb            50.0 %" in out
    assert "never in control" in out
    assert err == (
        "bbsd: the expectation of climb held in 0.5 of its steps, below 0.51 by 0.01\n" if code else ""
    )


def test_expectations_are_told_of_in_every_form(tmp_path):
    spec, table = tmp_path / "expecting.yaml", tmp_path / "episode.csv"
    spec.write_text(EXPECTING)
    code, out, _ = bbsd("evaluate", spec, "--exact", "--json", "--trace", table)
    assert code == 0
    assert json.loads(out)["expectation_share"] == {"climb": 0.5, "fall": None}
    head, *rows = table.read_text().splitlines()
    place = head.split(",").index("expectation")
    assert [row.split(",")[place] for row in rows] == ["", "held", "held", "failed", "failed"]
    assert "Expects afterwards: x < 5" in bbsd("explain", spec)[1]
    assert "expects: x < 5 " in bbsd("config", spec)[1]


def test_nothing_can_be_required_where_nothing_is_expected(designed):
    code, out, err = bbsd("evaluate", designed[0] / "architecture.yaml", "--expect-at-least", 0.5)
    assert (code, out) == (2, "")
    assert "no behavior of this spec has an expectation" in err


def test_holes_are_not_measured_unless_they_are_filled():
    code, out, err = bbsd("evaluate", SPEC)
    assert (code, out) == (2, "")
    assert "heat: 3 of 3 cells open" in err
    assert "--fill random" in err
    code, out, _ = bbsd("evaluate", SPEC, "--fill", "random", "--agents", 5, "--episodes", 4, "--json")
    assert code == 0
    assert (json.loads(out)["agents"], json.loads(out)["episodes"]) == (5, 20)


def test_an_episode_can_be_written_and_drawn(designed, tmp_path):
    table, figure = tmp_path / "episode.csv", tmp_path / "episode.svg"
    words = [
        "evaluate",
        designed[0] / "architecture.yaml",
        "--episodes",
        5,
        "--trace",
        table,
        "--plot",
        figure,
    ]
    assert bbsd(*words)[0] == 0
    assert len(table.read_text().splitlines()) == 22
    assert "<!-- warmth -->" in figure.read_text()


def test_a_search_can_be_drawn_anywhere_beside_another_design(designed, tmp_path):
    figure = tmp_path / "search.svg"
    words = ["design", SPEC, "--out", designed[0], "--resume", "--quiet", "--plot-to", figure]
    assert bbsd(*words)[0] == 0
    assert "<!-- random agents" in figure.read_text()
    assert bbsd(*words, "--plot-beside", designed[0])[0] == 0
    assert figure.read_text().count("<!-- thermostat") == 2  # the title, and the line of the same design


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--plot-beside", SPEC], "--plot-beside needs --plot or --plot-to"),
        (["--plot", "--plot-beside", SPEC], "the design has holes"),
        (["--plot-to", "no/search.png"], "no"),
        (["--plot-to", "search.gif"], "search.gif: the name of a figure's file ends with"),
    ],
)
def test_what_cannot_be_drawn_is_found_before_the_search(tmp_path, words, message):
    code, out, err = bbsd("design", SPEC, "--out", tmp_path / "out", *words, cwd=tmp_path)
    assert (code, out) == (2, "")
    assert message in err
    assert not (tmp_path / "out").exists()


def test_what_a_figure_shows_can_be_chosen(designed, tmp_path):
    words = [
        "evaluate",
        designed[0] / "architecture.yaml",
        "--episodes",
        2,
        "--plot-to",
        tmp_path / "episode.svg",
    ]
    assert bbsd(*words, "--show", "reward")[0] == 0
    assert "<!-- warmth -->" not in (tmp_path / "episode.svg").read_text()
    code, out, err = bbsd(*words, "--show", "warmht")
    assert (code, out) == (2, "")
    assert 'did you mean "warmth"' in err


def test_any_episode_can_be_written_by_its_number_or_its_rank(designed, tmp_path):
    table, returns = tmp_path / "episode.csv", tmp_path / "returns.csv"
    words = ["evaluate", designed[0] / "architecture.yaml", "--episodes", 30, "--json"]
    words += ["--trace", table, "--trace-format", "long", "--returns", returns]
    code, out, _ = bbsd(*words, "--episode", "worst")
    assert code == 0
    spread = json.loads(out)["spread"]
    by_episode = [float(line.split(",")[1]) for line in returns.read_text().splitlines()[1:]]
    assert (len(by_episode), by_episode.index(min(by_episode))) == (30, spread["episodes"]["worst"])
    assert earned(table) == pytest.approx(spread["worst"]) == min(by_episode)
    for number in (0, 7):
        bbsd(*words, "--episode", number)
        assert earned(table) == pytest.approx(by_episode[number])


def earned(table):
    """The return of an episode that was written as a long table, of one robot."""
    lines = [line.split(",") for line in table.read_text().splitlines()]
    assert lines[0] == ["step", "robot", "name", "value"]
    return sum(float(value) for _, _, name, value in lines[1:] if name.startswith("reward_"))


@pytest.mark.parametrize("words", [["--exact", "--episode", "best"], ["--episode", "first"]])
def test_an_episode_that_is_not_among_those_that_are_run_is_refused(designed, words):
    code, out, err = bbsd("evaluate", designed[0] / "architecture.yaml", *words)
    assert (code, out) == (2, "")
    assert "Traceback" not in err


@pytest.mark.parametrize(
    "words",
    [
        ["--trace", "no/episode.csv"],
        ["--plot-to", "episode.gif"],
        ["--trace", "."],
        ["--returns", "no/it.csv"],
    ],
)
def test_an_output_that_cannot_be_written_is_found_before_the_run(designed, tmp_path, words):
    code, out, err = bbsd("evaluate", designed[0] / "architecture.yaml", *words, cwd=tmp_path)
    assert (code, out) == (2, "")
    assert err.startswith("bbsd: ")


def test_an_explanation_as_text_and_as_json(designed):
    code, out, err = bbsd("explain", designed[0] / "architecture.yaml")
    assert (code, err) == (0, "")
    assert out.startswith("thermostat: 2 layers, highest first\n")
    code, out, err = bbsd("explain", designed[0] / "architecture.yaml", "--format", "json")
    assert (code, err) == (0, "")
    assert isinstance(json.loads(out), dict)


def test_a_run_stands_for_its_design(designed):
    folder = designed[0]
    code, out, err = bbsd("explain", folder)
    assert (code, err) == (0, "")
    assert "In 20 episodes, " in out
    assert bbsd("explain", folder / "architecture.yaml")[1] == out
    by_folder, by_file = (
        bbsd("evaluate", path, "--episodes", 5, "--json")[1]
        for path in (folder, folder / "architecture.yaml")
    )
    assert by_folder == by_file


def test_what_a_run_has_kept_counts_for_its_own_design_only(designed, tmp_path):
    folder = tmp_path / "edited"
    shutil.copytree(designed[0], folder)
    path = folder / "architecture.yaml"
    path.write_text(path.read_text() + "# by hand\n")
    code, out, err = bbsd("explain", folder)
    assert (code, "episodes" in out) == (0, False)
    assert err == f"the visits that {folder} has kept are of another design; --episodes N counts anew\n"


def test_a_folder_without_a_design_says_what_to_do(tmp_path):
    code, out, err = bbsd("explain", tmp_path)
    assert (code, out) == (2, "")
    assert "a run has the files architecture.yaml and run.json" in err
    (tmp_path / "run.json").write_text("{}")
    code, out, err = bbsd("evaluate", tmp_path)
    assert (code, out) == (2, "")
    assert "has no answer yet" in err
    assert f"bbsd design {tmp_path}/spec.yaml --resume --out {tmp_path}" in err


def test_a_reader_that_stops_reading_is_no_mistake():
    with process("compile", SPEC) as running:
        running.stdout.close()
        err = running.stderr.read()
    assert (running.returncode, err) == (0, "")
