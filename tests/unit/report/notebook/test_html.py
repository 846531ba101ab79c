from html.parser import HTMLParser

import pytest
from rich.console import Group
from rich.panel import Panel
from rich.table import Table
from rich.text import Text

from bbsd.report.notebook.html import html_of, preformatted, table_of

NASTY = "<script>alert('a')</script>\x1b[31m\u202e & more"


class Reader(HTMLParser):
    """The tags of a page and its texts; every tag that is opened is closed."""

    def __init__(self, page):
        super().__init__()
        self.tags, self.texts, self.opened = [], [], []
        self.feed(page)
        self.close()
        assert not self.opened

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        if tag != "br":
            self.opened.append(tag)

    def handle_endtag(self, tag):
        assert self.opened.pop() == tag

    def handle_data(self, data):
        self.texts.append(data)


def nasty_table():
    table = Table()
    table.add_column(Text(NASTY))
    table.add_column("number", justify="right")
    table.add_row(Text(NASTY), "3")
    table.add_row("two\nlines", "4")
    return table


@pytest.mark.parametrize(
    "page",
    [
        html_of(Group(NASTY, Text(NASTY), "", nasty_table())),
        preformatted(f"{NASTY}\n{NASTY}"),
        table_of([NASTY], [[NASTY]]),
    ],
)
def test_texts_cannot_be_more_than_texts(page):
    found = Reader(page)
    assert set(found.tags) <= {"p", "pre", "table", "thead", "tbody", "tr", "th", "td", "br"}
    assert "\x1b" not in page
    assert "\u202e" not in page
    assert "<script>alert('a')</script>" in "".join(found.texts)


def test_a_table_keeps_its_rows_and_columns():
    page = html_of(nasty_table())
    assert page.count("<tr>") == 3
    assert page.count('<th scope="col"') == 2
    assert '<td style="text-align: right">3</td>' in page
    assert "two<br>lines" in page


def test_numbers_of_a_table_stand_at_the_right():
    page = table_of(["a", "b", "c"], [[1.23456789, True, "x"]])
    assert '<td style="text-align: right">1.23457</td>' in page
    assert '<td style="text-align: left">True</td>' in page


def test_what_has_no_html_is_refused():
    with pytest.raises(TypeError, match="Panel has no HTML"):
        html_of(Panel("x"))
