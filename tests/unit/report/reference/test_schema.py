"""The JSON Schema that editors read agrees with `bbsd check` on the form of a spec."""

from __future__ import annotations

import re
from pathlib import Path

import jsonschema
import pytest

from bbsd.report.plain import json_text
from bbsd.report.reference.schema import SCHEMA_FILE, language_schema
from bbsd.text import Source, read

ROOT = Path(__file__).parents[4]
SHIPPED = [*sorted((ROOT / "specs").rglob("*.yaml")), *sorted((ROOT / "bbsd/cli/templates").glob("*.yaml"))]
VALID = sorted((ROOT / "tests/specs/valid").glob("*.yaml"))
OF_FORM = re.compile(r"BB02[0-467]")
TOLD_BY_CHECK_ALONE = {"BB022_infinity.yaml"}  # JSON has no infinity, and so no word for it
INVALID = [
    path
    for path in sorted((ROOT / "tests/specs/invalid").glob("*.yaml"))
    if OF_FORM.match(path.name) and path.name not in TOLD_BY_CHECK_ALONE
]
VALIDATOR = jsonschema.Draft7Validator(language_schema())


def names(paths):
    return [path.name for path in paths]


def data(path):
    return read(Source.read(path)).data


def test_the_file_in_the_repository_is_what_the_models_say(request):
    path = ROOT / "schema" / SCHEMA_FILE
    text = json_text(language_schema()) + "\n"
    if request.config.getoption("--update-golden"):
        path.write_text(text, encoding="utf-8", newline="\n")
    assert path.read_text(encoding="utf-8") == text


@pytest.mark.parametrize(
    "text",
    ["", "structure: null", "behaviors: {stop: null}", "environment: {steps: 3}", "constants: {a: null}",
     "behaviors: {stop: {actions: {halt: {speed: null}}}}", "design: {culture: null, sharing: null}"],
)  # fmt: skip
def test_a_spec_that_extends_another_may_lack_keys_and_take_some_away(text):
    assert VALIDATOR.is_valid(read(Source("spec", f"extends: base.yaml\n{text}\n")).data)
    assert not VALIDATOR.is_valid(read(Source("spec", f"bbsd: 1\n{text}\n")).data)


@pytest.mark.parametrize("text", ["stucture: null", "environment: {steps: many}", "constants: {Goal: 1}"])
def test_a_spec_that_extends_another_is_checked_too(text):
    assert not VALIDATOR.is_valid(read(Source("spec", f"extends: base.yaml\n{text}\n")).data)


def test_it_is_a_schema_without_tuples():
    schema = language_schema()
    jsonschema.Draft7Validator.check_schema(schema)
    assert all(isinstance(each, dict) for each in items(schema))


def items(schema):
    """Yield the values of all `items` in a schema, at any depth."""
    if isinstance(schema, dict):
        for key, value in schema.items():
            if key == "items":
                yield value
            yield from items(value)
    elif isinstance(schema, list):
        for each in schema:
            yield from items(each)


@pytest.mark.parametrize("path", [*SHIPPED, *VALID], ids=names([*SHIPPED, *VALID]))
def test_a_correct_spec_is_valid(path):
    assert [error.message for error in VALIDATOR.iter_errors(data(path))] == []


@pytest.mark.parametrize("path", INVALID, ids=names(INVALID))
def test_a_mistake_of_form_is_not(path):
    assert not VALIDATOR.is_valid(data(path))


@pytest.mark.parametrize("path", SHIPPED, ids=names(SHIPPED))
def test_a_shipped_spec_tells_editors_where_its_schema_is(path):
    first, *_ = path.read_text(encoding="utf-8").splitlines()
    found = re.fullmatch(r"# yaml-language-server: \$schema=(\S+)", first)
    assert found
    assert found[1] == SCHEMA_FILE or (path.parent / found[1]).samefile(ROOT / "schema" / SCHEMA_FILE)


def test_a_key_has_its_meaning_its_bounds_and_its_default():
    design = language_schema()["definitions"]["whole"]["properties"]["design"]
    agents = design["properties"]["coevolution"]["properties"]["agents"]
    assert agents == {
        "type": "integer",
        "minimum": 1,
        "maximum": 1_000_000,
        "default": 200,
        "description": "Agents put together in each generation. Default: 200",
    }


@pytest.mark.parametrize("block", ["x-notes", "speed", "speed_2"])
def test_free_keys_and_names_are_allowed(block):
    assert VALIDATOR.is_valid({**data(ROOT / "specs/abstract.yaml"), "constants": {block: 1}})


@pytest.mark.parametrize("block", ["Speed", "2", "step", "class", "a b"])
def test_other_keys_are_not_names(block):
    assert not VALIDATOR.is_valid({**data(ROOT / "specs/abstract.yaml"), "constants": {block: 1}})
