"""What a robot that carries a design must be given, and keep from step to step, so that it can decide for itself."""

from bbsd.architecture.needs.analysis import needs_of
from bbsd.architecture.needs.naming import ACTED, BEFORE, plain_name, plain_variable
from bbsd.architecture.needs.needs import Given, Needs, NotMeasured, NotRemembered, RobotNeeds

__all__ = [
    "ACTED",
    "BEFORE",
    "Given",
    "Needs",
    "NotMeasured",
    "NotRemembered",
    "RobotNeeds",
    "needs_of",
    "plain_name",
    "plain_variable",
]
