"""The worth of a design's parts, as tables for people, as plain data and graphs for programs."""

from bbsd.report.worth.graphs import order_dot, order_mermaid
from bbsd.report.worth.plain import worth_plain
from bbsd.report.worth.table import worth_table

__all__ = ["order_dot", "order_mermaid", "worth_plain", "worth_table"]
