"""Mistakes that only an environment shows are told at their place in the spec."""

import pytest

from bbsd.environments.for_spec import closed_folders, opened_for, settings
from bbsd.environments.importing.consent import consent
from bbsd.errors import SpecError
from bbsd.errors.catalog import KINDS
from bbsd.errors.kinds.environment import ENVIRONMENT_KINDS
from bbsd.language.lineage import overlay
from bbsd.language.loading import load
from bbsd.text import Source, read
from bbsd.text.writing.writer import write

pytest.importorskip("gymnasium")
ALLOWED = consent(["gymnasium", "minigrid", "mpe2"])
BASE = {
    "bbsd": 1,
    "name": "example",
    "environment": {
        "steps": 5,
        "observation": ["_", "_", "_", "_"],
        "action": "push",
        "state": {"push": 0},
    },
    "behaviors": {"go": {"actions": {"left": {"push": 0}, "right": {"push": 1}}}},
    "reward": {"earned": "earned"},
}
"""What the examples of the catalog are laid over."""
SPREAD = {"environment": {"observation": ["_"] * 18}}
AROUND = {
    "BB115": {"environment": {"observation": None}},
    "BB114": {"environment": {"observation": None}},
    "BB116": {"environment": {"observation": None}},
    "BB120": SPREAD,
    "BB124": SPREAD,
}
ELSEWHERE = {"BB119", "BB123"}
"""Kinds of which no shipped environment is an example: tested in `spaces/test_matching`, `importing`."""


def codes(code, example):
    base = overlay(BASE, AROUND.get(code, {}))
    data = overlay(base, read(Source("example", example)).data)
    loaded = load(Source("example.yaml", write(data)))
    try:
        opened_for(loaded, ALLOWED, 30.0)
    except SpecError as error:
        return {diagnosis.code for diagnosis in error.diagnoses}
    return set()


@pytest.mark.parametrize("code", sorted({kind.code for kind in ENVIRONMENT_KINDS} - ELSEWHERE))
def test_examples_of_the_catalog_have_their_mistake_and_mended_ones_do_not(code):
    for module in ("minigrid", "mpe2"):
        if module in KINDS[code].example:
            pytest.importorskip(module)
    assert codes(code, KINDS[code].example) == {code}
    assert codes(code, KINDS[code].mend) == set()


TEXT = """\
bbsd: 1
name: example
environment:
  gymnasium: CartPole-v1
  steps: 5
  observation: [a, b, c]
  action: push
  state: {push: 0.5}
behaviors:
  go:
    inputs: {side: a > 0}
    actions:
      left: {push: 0}
      far:
        push: 7
reward: {earned: earned}
"""


def test_all_misfits_are_told_in_the_order_of_the_text():
    loaded = load(Source("spec.yaml", TEXT))
    with pytest.raises(SpecError) as refused:
        opened_for(loaded, ALLOWED, 30.0)
    found = [(each.code, each.place.line, each.place.column) for each in refused.value.diagnoses]
    assert found == [("BB113", 6, 16), ("BB118", 8, 17), ("BB118", 15, 15)]
    assert "position, speed, angle, tip_speed" in refused.value.diagnoses[0].advice


def test_a_world_of_the_specs_own_is_not_opened():
    text = (
        TEXT.replace("  gymnasium: CartPole-v1\n", "")
        .replace("  action: push\n", "")
        .replace("earned}", "a}")
    )
    text = text.replace("  observation: [a, b, c]\n", "").replace("{push: 0.5}", "{push: 0.5, a: 1}")
    assert opened_for(load(Source("spec.yaml", text)), ALLOWED, 30.0) is None


def test_literal_values_are_found_where_they_stand():
    loaded = load(Source("spec.yaml", TEXT))
    found = {(each.value, each.path) for each in settings(loaded.meaning)}
    assert found == {
        (0.5, ("environment", "state", "push")),
        (0.0, ("behaviors", "go", "actions", "left", "push")),
        (7.0, ("behaviors", "go", "actions", "far", "push")),
    }


def test_folders_of_all_files_of_a_spec_are_closed(tmp_path):
    (tmp_path / "below").mkdir()
    (tmp_path / "below" / "base.yaml").write_text(TEXT, encoding="utf-8")
    spec = tmp_path / "spec.yaml"
    spec.write_text("extends: below/base.yaml\n", encoding="utf-8")
    loaded = load(Source.read(spec))
    assert closed_folders(loaded.lineage) == (str(tmp_path), str(tmp_path / "below"))
