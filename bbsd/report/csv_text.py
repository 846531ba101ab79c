"""An episode as comma-separated values."""

from __future__ import annotations

import csv
from io import StringIO
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bbsd.evaluation import Trace


def csv_text(trace: Trace) -> str:
    """Return a line with the names of a trace's columns, then a line for each step; numbers have all their digits."""
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(trace.columns)
    writer.writerows(trace.rows)
    return text.getvalue()
