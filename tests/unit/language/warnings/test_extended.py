"""Names that nothing uses are told with the name of the base that they nearly are."""

from pathlib import Path

import pytest

from bbsd.language.loading import load
from bbsd.text import Source
from tests.unit.language.specs import source


@pytest.mark.parametrize(
    ("part", "near"),
    [
        ("environment:\n  sensors:\n    titled: height > 2\n", "tilted"),
        ("environment:\n  sensors:\n    wide: height > 2\n", ""),
        ("environment:\n  sensors:\n    tilt: height\n    tilted: tilt > 2\n    titled: tilt > 2\n", ""),
    ],
)
def test_a_misspelled_sensor_of_the_base(tmp_path: Path, part: str, near: str) -> None:
    (tmp_path / "base.yaml").write_text(source().text, encoding="utf-8")
    path = tmp_path / "own.yaml"
    path.write_text(f"extends: base.yaml\n{part}", encoding="utf-8")
    told = [each for each in load(Source.read(path)).warnings if each.code == "BB201"]
    hint = f'; did you mean "{near}" of base.yaml?' if near else ""
    name = "wide" if "wide" in part else "titled"
    found = next(each for each in told if f"nothing uses the sensor {name}" in each.message)
    assert found.message == f"nothing uses the sensor {name}{hint}"
    assert (found.correction.edits[0].text if found.correction else "") == near
