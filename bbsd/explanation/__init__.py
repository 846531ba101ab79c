"""Architectures in words: their rules, which behavior controls where, and which rules never take effect."""

from bbsd.explanation.layers import Explanation, LayerInWords, RuleInWords, explain_architecture
from bbsd.explanation.text import explanation_text
from bbsd.explanation.vocabulary import GlossaryEntry

__all__ = [
    "Explanation",
    "GlossaryEntry",
    "LayerInWords",
    "RuleInWords",
    "explain_architecture",
    "explanation_text",
]
