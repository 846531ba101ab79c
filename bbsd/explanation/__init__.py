"""Architectures in words: their rules, which behavior controls where, and which rules never take effect."""

from bbsd.explanation.diagrams import dot_text, mermaid_text
from bbsd.explanation.layers import explain_architecture
from bbsd.explanation.text import explanation_text, table_text
from bbsd.explanation.trees import tree_text
from bbsd.explanation.vocabulary import GlossaryEntry
from bbsd.explanation.words import Condition, Explanation, LayerInWords, Row, RuleInWords, Useless

__all__ = [
    "Condition",
    "Explanation",
    "GlossaryEntry",
    "LayerInWords",
    "Row",
    "RuleInWords",
    "Useless",
    "dot_text",
    "explain_architecture",
    "explanation_text",
    "mermaid_text",
    "table_text",
    "tree_text",
]
