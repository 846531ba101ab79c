"""An architecture in words: its rules, who controls where, and what never happens."""

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
