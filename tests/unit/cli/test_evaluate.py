import pytest

from tests.unit.architecture.designs import SPECS
from tests.unit.cli.commands import run


@pytest.mark.parametrize(
    ("options", "needed"),
    [
        (["--show", "height"], "--show needs --plot-to"),
        (["--show", "height", "--trace", "trace.csv"], "--show needs --plot-to"),
        (["--episode", "worst"], "--episode needs --trace or --plot-to"),
        (["--episode", "3"], "--episode needs --trace or --plot-to"),
    ],
)
def test_options_without_effect_are_mistakes(options, needed, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run("evaluate", SPECS / "object_lifting_hand.yaml", *options) == 2
    assert needed in " ".join(capsys.readouterr().err.split())
    assert not [*tmp_path.iterdir()]
