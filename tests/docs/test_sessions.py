"""Every command that a document shows prints what it shows."""

from pathlib import Path

import pytest

from tests.docs.sessions import replayed
from tests.unit.exports.designs import tool

ROOT = Path(__file__).parents[2]


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        "README.md",
        *(f"docs/{page}.md" for page in ("tutorial", "howto", "understanding", "export", "environments")),
        *(f"docs/cookbook/{path.name}" for path in sorted((ROOT / "docs" / "cookbook").glob("*.md"))),
    ],
)
def test_a_document_shows_what_its_commands_print(name, tmp_path, request):
    if name == "docs/export.md":
        tool("gcc")
    (tmp_path / "specs").symlink_to(ROOT / "specs")
    path = ROOT / name
    text = path.read_text(encoding="utf-8")
    now = replayed(text, tmp_path)
    if request.config.getoption("--update-golden"):
        path.write_text(now, encoding="utf-8", newline="\n")
    else:
        assert now == text
