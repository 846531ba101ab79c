"""The figure of an episode, as in the paper's Fig. 22: with a scene from above where the spec has a view."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from bbsd.evaluation import Trace
    from bbsd.language.models import Spec


def draw_episode(
    trace: Trace, spec: Spec, path: Path, *, episode: int | None = None, show: Sequence[str] = ()
) -> None:
    """Draw the values of an episode at its start and after each step, what it earned, and who was in control.

    Shown are state and world, and sensors that are numbers and equal for all robots, eight values at most in the
    spec's order, or those that `show` names; what is left out is named below. With many robots a value is a strip for
    each. If the spec has a view, the episode is drawn from above, with these panels beside it. Raises FigureError for
    an unknown kind of file or name, and OSError if the file cannot be written.
    """
    if trace.scene is None:
        from bbsd.report.figures.over_steps import draw_over_steps

        draw_over_steps(trace, spec, path, episode, show)
    else:
        from bbsd.report.figures.scene import draw_with_scene

        draw_with_scene(trace, spec, trace.scene, path, episode, show)
