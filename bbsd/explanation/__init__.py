"""An architecture in words: its rules, who controls where, and what never happens."""

from bbsd.explanation.explain import Explanation, LayerInWords, RuleInWords, explain
from bbsd.explanation.text import as_text
from bbsd.explanation.vocabulary import Entry

__all__ = ["Entry", "Explanation", "LayerInWords", "RuleInWords", "as_text", "explain"]
