"""What the parts of a design are worth: behaviors, layers, rules, their order; and what stands out."""

from bbsd.explanation.worth.appraisal import Appraisal
from bbsd.explanation.worth.results import (
    BehaviorWorth,
    Finding,
    Order,
    Precedence,
    RobotsAlike,
    RuleWorth,
    Swap,
    Worth,
)

__all__ = [
    "Appraisal",
    "BehaviorWorth",
    "Finding",
    "Order",
    "Precedence",
    "RobotsAlike",
    "RuleWorth",
    "Swap",
    "Worth",
]
