"""Calls of an environment's own code: limited in time, prints told apart from results, errors in words."""

from __future__ import annotations

import sys
from contextlib import contextmanager, redirect_stdout
from typing import TYPE_CHECKING

from bbsd.environments.failures import ActionRefused, EnvironmentFailed, EnvironmentHangs, failure_text
from bbsd.environments.lanes.time_limit import CallTooLongError
from bbsd.environments.spaces.misfits import UnfitError
from bbsd.environments.spaces.reading import WrongObservationError
from bbsd.environments.spaces.sending import WrongValueError
from bbsd.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from bbsd.environments.lanes.time_limit import CallWatch


@contextmanager
def calling(where: Callable[[], str], watch: CallWatch, actions: Sequence[str] = ()) -> Iterator[None]:
    """Let an environment's own code be called inside.

    Args:
        where: says what is called, once it failed.
        watch: limits the time of a call; each call is counted in it.
        actions: the names of the state that is sent.

    Raises:
        EnvironmentHangs, EnvironmentFailed, ActionRefused: in place of what the code raised; errors of the user's and
            interrupts stay what they are.
    """
    try:
        with redirect_stdout(sys.stderr), watch:
            yield
    except (UsageError, UnfitError, KeyboardInterrupt):
        raise
    except WrongObservationError as error:
        raise EnvironmentFailed(f"{where()}: {error}") from None
    except WrongValueError as error:
        sent = f"{actions[error.index]} is {error.value!r}"
        raise ActionRefused(f"{where()}: {sent}, and the environment takes {error.taken}") from None
    except CallTooLongError:
        raise EnvironmentHangs(f"{where()}: it did not return within {watch.seconds:g} s") from None
    except (Exception, SystemExit) as error:  # noqa: BLE001 - all that somebody else's code may raise
        raise EnvironmentFailed(failure_text(where(), error)) from None
