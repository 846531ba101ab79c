"""Results as data frames of pandas, which is needed for nothing else."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bbsd.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence


class NoPandas(UsageError):
    """A data frame is wanted, and pandas is not installed."""

    advice = "install it: python -m pip install pandas"


def frame(columns: Mapping[str, Sequence[object]], index: str = "") -> Any:  # noqa: ANN401 - pandas is optional
    """Return columns of equal length as a pandas DataFrame, one of them as its index where it is named.

    Raises NoPandas where pandas is not installed.
    """
    try:
        import pandas as pd
    except ImportError:
        raise NoPandas("pandas is not installed, so there are no data frames") from None
    made = pd.DataFrame(dict(columns))
    return made.set_index(index) if index else made


def metrics_frame(lines: Iterable[Mapping[str, Any]]) -> Any:  # noqa: ANN401 - pandas is optional
    """Return lines of metrics as a pandas DataFrame; a structure is a text, a mapping has a column for each value.

    Raises NoPandas where pandas is not installed.
    """
    rows = [_flat(line) for line in lines]
    names = dict.fromkeys(name for row in rows for name in row)
    return frame({name: [row.get(name) for row in rows] for name in names})


def _flat(line: Mapping[str, Any]) -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for key, value in line.items():
        if isinstance(value, dict):
            flat |= {f"{key}/{name}": item for name, item in value.items()}
        else:
            flat[key] = " ".join(map(str, value)) if isinstance(value, list) else value
    return flat
