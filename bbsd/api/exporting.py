"""Write a design in another language, and verify through the real target what was written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from bbsd.api.given.arguments import Assignments, checked, require_none
from bbsd.api.specs import AnySpec, loaded_from
from bbsd.architecture import architecture_of
from bbsd.errors import UsageError, did_you_mean
from bbsd.exports.exported import Options, exported_design
from bbsd.exports.targets import TARGETS
from bbsd.exports.verification.comparing import Verified
from bbsd.exports.verification.comparing import verify as verify_files
from bbsd.exports.verification.following import Followed, follow

if TYPE_CHECKING:
    from collections.abc import Collection

    from bbsd.exports.exported import Files


EPISODES = 3
"""Recorded episodes beside which sensors are run, by default."""


class NoSuchTarget(UsageError):
    """A target that designs cannot be written for."""

    advice = f"the targets are {', '.join(TARGETS)}"


class NoLeaves(UsageError):
    """Leaves are asked for of a target that has none, or that has one kind of them."""

    advice = "the target btcpp has custom leaves"


class NoSensing(UsageError):
    """Sensors are to be written for a target that has none, or something is said of them where they are not written."""

    advice = "sensors are written with --to c --sensing"


@dataclass(frozen=True, slots=True)
class Export:
    """A design in another language: the texts of files by name, the main one first, and what came of verifying them."""

    design: str
    digest: str
    target: str
    files: Files
    verified: tuple[Verified, ...]
    """What came of each tool that ran the files; empty where that was not asked for, or nothing runs them."""
    followed: Followed | None = None
    """What came of running sensors and assignments beside the design; None where they are not written or verified."""

    def __repr__(self) -> str:
        return f"<Export of {self.design}: {', '.join(self.files)}>"

    @property
    def text(self) -> str:
        """The text of the main file."""
        return next(iter(self.files.values()))

    @property
    def is_verified(self) -> bool:
        """Whether every tool that is needed ran it, and all answers of all tools that ran were equal."""
        needed = [each for each in self.verified if each.needed]
        return (
            bool(needed)
            and all(each.is_equal or (each.missing and not each.needed) for each in self.verified)
            and (self.followed is None or self.followed.is_equal)
        )


@checked()
def export(
    spec: AnySpec,
    to: str,
    *,
    verify: bool = False,
    sensing: bool = False,
    measured: Collection[str] = (),
    remembered: Collection[str] = (),
    episodes: int = EPISODES,
    leaves: Literal["script", "custom"] = "script",
    seed: int = 0,
    set: Assignments = (),
) -> Export:
    """Write a design in another language.

    Args:
        spec: A design: a spec without holes, or the folder of a run.
        to: The target, one of `bbsd.exports.targets.TARGETS`.
        verify: Run what was written through the target, in all joint cells or a sample of many.
        sensing: Also write sensors, excitation and assignments, in C.
        measured: With `sensing`, sensors and state that the robot measures, so that they are given.
        remembered: With `sensing`, state that the robot keeps itself, though nothing but the dynamics change it.
        episodes: With `sensing`, recorded episodes beside which `verify` runs what was written.
        leaves: How the leaves of a tree are written.
        seed: Seed of the draws in constants.
        set: Values that replace those of the spec.

    Raises:
        SpecError: with all mistakes of the spec.
        HolesLeft: the spec has holes.
        NoSuchTarget: there is no such target.
        NoLeaves: another target than btcpp has no custom leaves.
        NoSensing: another target than C has no sensors, or values are measured or remembered without them.
        NotMeasured, NotRemembered: nothing of such a name can be.
    """
    if to not in TARGETS:
        raise NoSuchTarget(f"{to!r} is no target{did_you_mean(to, TARGETS)}")
    if leaves != "script" and to != "btcpp":
        raise NoLeaves(f"{to} has no {leaves} leaves")
    if sensing and to != "c":
        raise NoSensing(f"{to} has no sensors")
    if not (verify and sensing):
        require_none(["episodes"] if episodes != EPISODES else [], "without verify and sensing")
    if (measured or remembered) and not sensing:
        raise NoSensing("values are measured or remembered only where sensors are written")
    loaded = loaded_from(spec, seed, set)
    exported = exported_design(loaded.meaning, architecture_of(loaded.meaning))
    target = TARGETS[to]
    options = Options(sensing, tuple(measured), tuple(remembered), leaves)
    files = target.write(exported, options)
    verified = verify_files(exported, files, target.runners) if verify else []
    followed = follow(exported, options, files, episodes) if verify and sensing else None
    controller = exported.controller
    return Export(controller.name, controller.digest, to, files, tuple(verified), followed)
