from __future__ import annotations

from pathlib import Path

import pytest

from bbsd.language.loading import load
from bbsd.report.spec.size import size_text
from bbsd.text import Source

SPECS = Path(__file__).parents[4] / "specs"


@pytest.mark.parametrize(
    ("name", "overrides", "expected"),
    [
        ("object_lifting", [], "5 behaviors, 21 open cells, 5 open layers, search space 10^8.4"),
        ("object_lifting_hand", [], "5 behaviors, no holes"),
        ("object_lifting_hand", ["structure=null"], "5 behaviors, 5 open layers, search space 10^2.1"),
        (
            "object_lifting_hand",
            ["behaviors.push_more.rules=null"],
            "5 behaviors, 1 open cell, search space 10^0.3",
        ),
    ],
)
def test_a_spec_is_sized_up_by_what_is_open(name, overrides, expected):
    loaded = load(Source.read(SPECS / f"{name}.yaml"), overrides=overrides)
    assert size_text(loaded.meaning) == expected
