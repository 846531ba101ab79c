"""One page on a design: a file that holds all it needs, to look at in a browser."""

from bbsd.report.page.document import page_text

__all__ = ["page_text"]
