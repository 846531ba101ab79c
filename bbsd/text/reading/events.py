"""The events of PyYAML's parser, reduced to what a tree of nodes needs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

import yaml
from yamlcore import CCoreLoader

if TYPE_CHECKING:
    from collections.abc import Iterator

EventKind: TypeAlias = Literal["stream", "document", "alias", "scalar", "list", "mapping", "end"]

EVENT_KINDS: dict[type[yaml.Event], EventKind] = {
    yaml.StreamStartEvent: "stream",
    yaml.DocumentStartEvent: "document",
    yaml.AliasEvent: "alias",
    yaml.ScalarEvent: "scalar",
    yaml.SequenceStartEvent: "list",
    yaml.MappingStartEvent: "mapping",
    yaml.SequenceEndEvent: "end",
    yaml.MappingEndEvent: "end",
    yaml.DocumentEndEvent: "end",
    yaml.StreamEndEvent: "end",
}


class Event(NamedTuple):
    """One event of the parser; `text` is a scalar's value, `style` its first character, or '' if it is plain."""

    kind: EventKind
    start: int
    end: int
    text: str
    style: str
    flow: bool
    anchor: str | None
    tag: str | None


def events(text: str) -> Iterator[Event]:
    """Yield the events of a text as far as it is YAML; raises MarkedYAMLError where it is not."""
    for event in yaml.parse(text, Loader=CCoreLoader):
        start, end = event.start_mark, event.end_mark
        yield Event(
            kind=EVENT_KINDS[type(event)],
            start=start.index if start else 0,
            end=end.index if end else 0,
            text=getattr(event, "value", ""),
            style=getattr(event, "style", "") or "",
            flow=bool(getattr(event, "flow_style", False)),
            anchor=getattr(event, "anchor", None),
            tag=getattr(event, "tag", None),
        )
