import json
from io import StringIO

import pytest
from rich.console import Console

from bbsd.architecture import given_architecture
from bbsd.evaluation import evaluation_key
from bbsd.evaluation.faults import read_faults
from bbsd.explanation.faults import degradations
from bbsd.report.faults import faults_plain, faults_table
from bbsd.report.plain import json_text
from tests.unit.explanation.worth.planted import planted
from tests.unit.problems import problem_of

TEXTS = ["behavior=grab:silent", "behavior=work:random", "behavior=guard:stuck@5"]


@pytest.fixture(scope="module")
def found():
    problem = problem_of(planted())
    faults = read_faults(TEXTS, problem.meaning)
    return degradations(problem, given_architecture(problem), faults, evaluation_key(0), 50, 1, relearn=True)


def test_a_table_has_a_row_for_each_fault(found):
    console = Console(file=StringIO(), width=80, color_system=None)
    console.print(faults_table(found), crop=False)
    text = "\n".join(line.rstrip() for line in console.file.getvalue().splitlines())
    first, again = text.split("\n\n")
    assert [line.split()[0] for line in first.splitlines()[:5]] == ["fault", "none", *TEXTS]
    none, silent = (line.split() for line in first.splitlines()[1:3])
    assert float(none[1]) == pytest.approx(found.returns.mean, abs=1e-3)
    assert float(silent[3]) == pytest.approx(found.faults[0].change.mean, abs=1e-3)
    assert "random: the mean over 25 random tables" in first
    assert again.startswith("order learned again around")
    for each in found.faults:
        (row,) = (line for line in again.splitlines() if line.startswith(f"{each.fault.text} "))
        if each.relearned.structure == found.structure:
            assert row.endswith("as it was")
        else:
            assert f"{each.fault.text}: {' '.join(each.relearned.structure)}" in again
    kept = [each.relearned.structure == found.structure for each in found.faults]
    assert any(kept)
    assert not all(kept)


def test_programs_get_all_of_it(found):
    plain = json.loads(json_text(faults_plain(found)))
    assert plain["return"]["mean"] == found.returns.mean
    assert [each["fault"] for each in plain["faults"]] == TEXTS
    assert plain["faults"][2]["since"] == 5
    for each, fault in zip(plain["faults"], found.faults, strict=True):
        assert each["change"]["ci95"] == [fault.change.low, fault.change.high]
        assert each["relearned"]["gain"]["mean"] == fault.relearned.gain.mean
