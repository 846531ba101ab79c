"""The `view` block: how an episode is drawn from above. Nothing that a design depends on."""

from __future__ import annotations

from pydantic import Field

from bbsd.language.base import Entries, Part
from bbsd.language.field_types import ExpressionText, NameText, TableText  # noqa: TC001 - pydantic reads annotations


class View(Part):
    """How an episode is drawn from above; no result depends on it. A place is `[x, y]` or `[x, y, radius]`."""

    at: TableText = Field(description="Where a robot is: a place; a radius is its body's.")
    heading: ExpressionText | None = Field(
        None, description="Where a robot faces, in radians from the x axis towards the y axis."
    )
    area: TableText | None = Field(
        None, description="The walls around: `[x, y, x, y]`, the corners at bottom left and top right."
    )
    circles: TableText | None = Field(
        None, description="What is round and in the way: rows of `[x, y, radius]`."
    )
    grid: TableText | None = Field(
        None, description="Walls as a table, the top row first; what is not 0 stands at `[column, row]`."
    )
    paths: Entries[NameText, TableText] = Field(
        {}, description="Lines by name, such as a track or a wall: the rows `[x, y]` of their points."
    )
    marks: Entries[NameText, TableText] = Field(
        {}, description="Other places, by name; a radius is drawn as a ring, and what moves leaves a trail."
    )
