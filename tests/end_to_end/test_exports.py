"""Every shipped design in every language, and one that was designed: equal in all cells."""

from pathlib import Path

import pytest

import bbsd
from bbsd.architecture import holes_of
from bbsd.exports.targets import TARGETS
from tests.end_to_end.commands import bbsd as run
from tests.unit.architecture.designs import SPECS
from tests.unit.exports.designs import require

THERMOSTAT = Path(__file__).parent / "specs" / "thermostat.yaml"
DESIGNS = sorted(
    str(path.relative_to(SPECS)) for path in SPECS.rglob("*.yaml") if not holes_of(bbsd.load(path).meaning)
)
VERIFIABLE = sorted(name for name, target in TARGETS.items() if target.runners)


def test_designs_made_by_hand_are_among_them():
    assert len([name for name in DESIGNS if name.endswith("_hand.yaml")]) >= 16
    assert VERIFIABLE == ["btcpp", "c", "python", "pytrees"]


def assert_equal(design, target):
    export = bbsd.export(design, target, verify=True)
    for verified in export.verified:
        require(verified)
        assert verified.is_equal, verified
        assert verified.is_proof
        assert verified.compared == verified.joint_size


@pytest.mark.slow
@pytest.mark.parametrize("target", VERIFIABLE)
@pytest.mark.parametrize("design", DESIGNS)
def test_a_shipped_design_is_equal_in_all_cells(design, target):
    assert_equal(SPECS / design, target)


@pytest.mark.slow
def test_what_was_designed_is_equal_in_all_cells_and_a_folder_stands_for_it(tmp_path):
    code, _, err = run("design", THERMOSTAT, "--out", tmp_path / "run")
    assert code == 0, err
    for target in VERIFIABLE:
        assert_equal(tmp_path / "run", target)
    code, out, _ = run("export", tmp_path / "run", "--to", "python")
    assert code == 0
    assert out == bbsd.export(tmp_path / "run" / "architecture.yaml", "python").text
