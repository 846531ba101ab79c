"""What an environment shows and takes: as YAML that can be pasted, and as JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bbsd.errors import escape, render_json

if TYPE_CHECKING:
    from bbsd.api import Spaces


def spaces_text(spaces: Spaces) -> str:
    """Return the block `environment` of a spec, below comments that say what it is of."""
    versions = [f"{name} {version}" for name, version in spaces.origin.items() if name != "source"]
    head = [
        f"# {spaces.target}{', ' if versions else ''}{', '.join(versions)}",
        f"# observation: {spaces.observation}",
        f"# action: {spaces.action}",
    ]
    head += [f"# agents: {' '.join(spaces.agents)}"] if spaces.agents else []
    return "\n".join(map(escape, head)) + "\n" + spaces.proposal


def spaces_plain(spaces: Spaces) -> dict[str, Any]:
    """Return the same as plain data."""
    mistakes = spaces.mistakes
    return {
        "target": spaces.target,
        "origin": dict(spaces.origin),
        "observation": spaces.observation,
        "action": spaces.action,
        "agents": list(spaces.agents),
        "step_limit": spaces.step_limit,
        "proposal": spaces.proposal,
        "mistakes": [] if mistakes is None else render_json(mistakes.mistakes),
    }
