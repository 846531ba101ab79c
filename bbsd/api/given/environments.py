"""Open the environment of a spec, where its world is one that is stepped in Python."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from bbsd.api.given.arguments import require_none
from bbsd.compiler import compile_meaning
from bbsd.environments.importing.configuration import allowed_by_configuration, configuration_file
from bbsd.environments.importing.consent import consent
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT
from bbsd.errors import escape

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from bbsd.compiler import Problem
    from bbsd.environments.importing.consent import Consent
    from bbsd.environments.importing.modules import Announce
    from bbsd.environments.opening import Opened
    from bbsd.language.loading import Loaded
    from bbsd.language.meaning import Meaning


def opened_environment(
    loaded: Loaded,
    allow_import: Sequence[str] = (),
    import_from: Sequence[str | Path] = (),
    environment: Callable[..., Any] | None = None,
    step_limit: float = DEFAULT_LIMIT,
    announce: Announce | None = None,
    by_table: bool = True,
    note: Callable[[str], object] | None = None,
) -> Opened | None:
    """Open the environment of a spec; None where the spec's world is its own, for which nothing is read or imported.

    Args:
        loaded: the spec.
        allow_import: modules that may be imported, with all below them.
        import_from: folders in which modules are looked for, after the installed environment.
        environment: a class that the caller has in hand, in place of what the spec names.
        step_limit: seconds that a step or a reset may take.
        announce: called with each module and its file before it is imported.
        by_table: step it by its table of transitions, if it has one, and real steps agree with it.
        note: called with a sentence on that, if it has one.
    """
    if loaded.spec.environment.outside is None:
        require_none([] if environment is None else ["environment"], "where the spec's world is its own")
        return None
    from bbsd.environments.for_spec import opened_for

    allowed = users_consent(allow_import, import_from)
    opened = opened_for(loaded, allowed, step_limit, given=environment, announce=announce)
    return opened if opened is None or not by_table else _with_table(opened, loaded.meaning, note)


def _with_table(opened: Opened, meaning: Meaning, note: Callable[[str], object] | None) -> Opened:
    """Return an environment with its table of transitions, if it steps by one that goes with the spec."""
    from bbsd.compiler.tabulated import NotTabulated, require_tabulable
    from bbsd.environments.table_check import checked_table
    from bbsd.environments.tables import NoTable

    say = note or (lambda _: None)
    name = escape(opened.name)
    try:
        found = checked_table(opened)
        if found is None:
            return opened
        table, check = found
        require_tabulable(meaning, table)
    except (NoTable, NotTabulated) as reason:
        say(f"{name} has a table of transitions, but is stepped in Python: {escape(str(reason))}")
        return opened
    size = f"{table.n_states} states, {table.n_actions} actions"
    say(f"{name} is stepped by its table of transitions ({size}), with which {check.steps} real steps agreed")
    return replace(opened, table=table)


def users_consent(allow_import: Sequence[str], import_from: Sequence[str | Path]) -> Consent:
    """Return the consent of a call together with that of the user's configuration file."""
    given = consent(allow_import, import_from)
    configured = allowed_by_configuration(configuration_file())
    return consent([*given.modules, *configured], given.folders)


def problem_of(
    loaded: Loaded,
    opened: Opened | None,
    *,
    lanes: int | None = None,
    jobs: int = 1,
    compiled: bool = True,
) -> Problem:
    """Return the problem of a spec, stepped by its environment, or that's table, where there is one."""
    stepper, table = (None, None) if opened is None else (opened.stepper, opened.table)
    return compile_meaning(
        loaded.meaning, lanes=lanes, compiled=compiled, jobs=jobs, stepper=stepper, table=table
    )
