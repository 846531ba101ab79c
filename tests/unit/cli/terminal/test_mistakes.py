from __future__ import annotations

import pytest

from bbsd.architecture import HolesLeft
from bbsd.cli.terminal.mistakes import MISTAKE, show_mistake
from bbsd.errors import Diagnosis, Place, SpecError
from bbsd.text import Source


def test_every_mistake_of_a_spec_is_shown_with_its_line(capsys):
    source = Source("a.yaml", "steps: 0\nrobots: x\n")
    places = (Place("a.yaml", 1, 8), Place("a.yaml", 2, 9))
    assert (
        show_mistake(SpecError([Diagnosis("BB023", "too few", place) for place in places], source)) == MISTAKE
    )
    err = capsys.readouterr().err
    assert "a.yaml:1:8: error[BB023]: too few\n    1 | steps: 0\n" in err
    assert "\n\na.yaml:2:9: error[BB023]: too few\n    2 | robots: x\n" in err


def test_a_file_of_the_system_s_errors_is_named(capsys):
    assert show_mistake(PermissionError(13, "Permission denied", "run/metrics.jsonl")) == MISTAKE
    assert capsys.readouterr().err == "bbsd: run/metrics.jsonl: Permission denied\n"


def test_holes_come_with_the_advice_to_fill_them(capsys):
    assert show_mistake(HolesLeft("5 of 5 layers open")) == MISTAKE
    err = capsys.readouterr().err
    assert err.startswith("bbsd: 5 of 5 layers open\n")
    assert "bbsd design" in err


def test_our_own_mistakes_are_not_hidden():
    with pytest.raises(ZeroDivisionError):
        show_mistake(ZeroDivisionError())
