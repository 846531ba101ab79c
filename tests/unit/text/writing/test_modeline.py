import pytest

from bbsd.text.writing.modeline import without_relative_modeline

REST = "# A task.\nbbsd: 1\n# yaml-language-server: $schema=later.json\n"


@pytest.mark.parametrize(
    "line",
    [
        "# yaml-language-server: $schema=../schema/bbsd.schema.json",
        "#yaml-language-server: $schema=bbsd.schema.json",
        "# yaml-language-server : $schema=./bbsd.schema.json",
        "# yaml-language-server: $schema=bbsd.schema.json\r",
    ],
)
def test_a_relative_path_to_the_schema_is_left_out(line):
    assert without_relative_modeline(f"{line}\n{REST}") == REST
    assert without_relative_modeline(f"# first\n\n{line}\n{REST}") == f"# first\n\n{REST}"


@pytest.mark.parametrize(
    "line",
    [
        "# yaml-language-server: $schema=https://example.org/bbsd.schema.json",
        "# yaml-language-server: $schema=file:///opt/bbsd.schema.json",
        "# yaml-language-server: $schema=/opt/bbsd.schema.json",
        "# yaml-language-server: $schema=C:\\bbsd.schema.json",
        "# yaml-language-server: $schema=~/bbsd.schema.json",
        "# yaml-language-server: $schema=none",
        "# yaml-language-server: disable",
        "# $schema=bbsd.schema.json",
        "x-note: '# yaml-language-server: $schema=bbsd.schema.json'",
    ],
)
def test_everything_else_stays(line):
    assert without_relative_modeline(f"{line}\n{REST}") == f"{line}\n{REST}"


@pytest.mark.parametrize("text", ["", "\n", "# only a comment", "# yaml-language-server: $schema=a.json"])
def test_texts_without_content(text):
    assert without_relative_modeline(text) == ("" if "schema" in text else text)
