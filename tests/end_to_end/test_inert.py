"""A stranger's spec and a stranger's file names show nothing that steers, hides, or begins a command."""

import re
from pathlib import Path

import pytest

from tests.end_to_end.commands import bbsd

NASTY = "\x1b[2J\x1b]0;owned\x07\u202e\u2066\x9b31m\r\n::error::owned\n##[error]owned"
HOSTILE = r"""
bbsd: 1
name: "nasty \e[2J \u202e ::error::x \x9b31m"
summary: "\e]0;owned\a\r\n::error::owned"
constants: {goal: 3}  # comment
environment:
  steps: 3
  state: {x: 0}
  sensors:
    place: {"=cmd|' /C calc'!A0": x < 1, "\e[8mhidden \u202e": otherwise}
behaviors:
  go:
    inputs: [place]
    actions: {set: {x: x + 1}}
    rules: [{when: {place: "=cmd|' /C calc'!A0"}, do: set}, otherwise: no action]
structure: [go]
reward: {r: x}
"""
COMMANDS = [
    "check {}", "check {} --format json", "check {} --format sarif", "check {} --format github", "config {}",
    "config {} --json", "fmt {} --diff", "evaluate {} --episodes 2", "evaluate {} --episodes 2 --json", "explain {}",
    "explain {} --json", "explain {} --format table", "explain {} --format mermaid", "explain {} --format dot",
    "why {} --step 1", "tidy {} --diff", "worth {} --episodes 4", "compare {} {} --episodes 4", "compile {}",
    "evaluate {} --trace trace.csv", "report {} -o page.html --episodes 4", "design {}", "export {} --to python",
    "export {} --to c", "export {} --to btcpp", "no-such-command {}", "evaluate {} --no-such-option-{}",
]  # fmt: skip
STEERS = re.compile(
    r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\u2028\u2029]|^::|^##\[", re.MULTILINE
)


@pytest.fixture(params=["good", "bad", "missing"])
def spec(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A spec with a hostile name, with hostile texts in it, which is right, wrong or not there."""
    path = tmp_path / f"a{NASTY.replace('/', '')}.yaml"
    text = HOSTILE if request.param == "good" else HOSTILE.replace("x < 1", "xx \u202e < 1")
    if request.param != "missing":
        path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("command", COMMANDS)
def test_nothing_that_is_shown_steers(command: str, spec: Path, tmp_path: Path) -> None:
    words = [word.replace("{}", spec.name) for word in command.split()]
    code, out, err = bbsd(*words, cwd=tmp_path)
    assert code in (0, 1, 2)
    github = "github" in command
    for text in (out, err):
        assert not [found for found in STEERS.findall(text) if not (github and found == "::")]
    for path in (tmp_path / "trace.csv", tmp_path / "page.html"):
        if path.exists():
            text = path.read_text(encoding="utf-8")
            assert not STEERS.search(text)
            assert not re.search(r"(^|,)=", text, re.MULTILINE) or path.suffix == ".html"


def test_what_is_printed_for_github_is_a_command_for_each_mistake_and_no_more(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text(HOSTILE.replace("x < 1", "xx < 1"), encoding="utf-8")
    code, out, _ = bbsd("check", "a.yaml", "--format", "github", cwd=tmp_path)
    assert code == 2
    assert all(line.startswith("::error file=a.yaml,") for line in out.splitlines())
