"""Architectures: given or learned tables and structure, their policy, and their text as a spec."""

from bbsd.architecture.architecture import (
    Architecture,
    HolesLeft,
    architecture_of,
    given_architecture,
    holes,
    holes_of,
)
from bbsd.architecture.document import designed_text, require_writable
from bbsd.architecture.policy import JointSpace, behavior_keys, joint_space, policy
from bbsd.architecture.rules import rules_of
from bbsd.architecture.spec_changes import spec_changes
from bbsd.architecture.tidy import tidy_tables

__all__ = [
    "Architecture",
    "HolesLeft",
    "JointSpace",
    "architecture_of",
    "behavior_keys",
    "designed_text",
    "given_architecture",
    "holes",
    "holes_of",
    "joint_space",
    "policy",
    "require_writable",
    "rules_of",
    "spec_changes",
    "tidy_tables",
]
