"""The reference's generated parts are up to date, and its examples mean something."""

import re
from pathlib import Path

import pytest

from bbsd.language.loading import check
from bbsd.language.meaning import elaborate
from bbsd.language.models import Spec
from bbsd.report.reference.language import regenerate
from bbsd.text import Source, read

PAGE = Path(__file__).parents[2] / "docs" / "language.md"
SNIPPET = re.compile(r"^```yaml(?: (BB\d+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
AROUND = {
    "bbsd": 1,
    "name": "around-a-snippet",
    "environment": {"robots": 3, "steps": 10, "state": {"height": 0, "speed": 0}},
    "behaviors": {"go": {"inputs": {"high": "height > 1"}, "actions": {"push": {"speed": "speed + 1"}}}},
    "reward": {"quick": "speed"},
}
"""What the examples leave out."""


def snippets():
    return [
        pytest.param(code, text, id=text.splitlines()[0])
        for code, text in SNIPPET.findall(PAGE.read_text(encoding="utf-8"))
    ]


def merged(base, more):
    if not (isinstance(base, dict) and isinstance(more, dict)):
        return more
    return {**base, **{key: merged(base.get(key), value) for key, value in more.items()}}


def test_generated_parts_are_up_to_date(request):
    text = PAGE.read_text(encoding="utf-8")
    if request.config.getoption("--update-golden"):
        PAGE.write_text(regenerate(text), encoding="utf-8", newline="\n")
    else:
        assert regenerate(text) == text


@pytest.mark.parametrize(("code", "text"), snippets())
def test_an_example_means_something_in_a_spec(code, text):
    if code:
        assert code in [diagnosis.code for diagnosis in check(Source("example.yaml", text))]
        return
    document = read(Source("example.yaml", text))
    assert not document.diagnoses
    assert elaborate(Spec.model_validate(merged(AROUND, document.data)), 0)[1] == ()
