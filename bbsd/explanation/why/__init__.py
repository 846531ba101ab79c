"""Why a robot did what it did, and what would have had to be different."""

from bbsd.explanation.why.answer import Answer, answer_of
from bbsd.explanation.why.described import described_situation
from bbsd.explanation.why.situation import Situation, situation_in
from bbsd.explanation.why.text import answer_text

__all__ = ["Answer", "Situation", "answer_of", "answer_text", "described_situation", "situation_in"]
