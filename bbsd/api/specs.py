"""Load and check a spec."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.errors import Diagnosis, SpecError
from bbsd.language.loading import Loaded, loaded_again
from bbsd.language.loading import check as check_source
from bbsd.language.loading import load as load_source
from bbsd.runs.storage.finished import design_file
from bbsd.text import Source

if TYPE_CHECKING:
    from collections.abc import Sequence


EPISODES_OF_DESIGN = 1000
"""Episodes in which a design is measured, by default: of all verbs the same, so that their numbers agree."""
AnySpec = str | Path | Loaded
"""The path of a spec's file, the folder of a run, which stands for its design, or a loaded spec."""


def load(spec: AnySpec, *, seed: int = 0, overrides: Sequence[str] = ()) -> Loaded:
    """Read and check a spec; random draws in its constants depend on the seed.

    Overrides change a spec that is loaded already too; the draws in its constants were made when it was loaded.

    Raises:
        SpecError: with all mistakes of the spec, or if its file cannot be read.
        NoDesign: a folder that is no run, or a run without an answer.
    """
    if isinstance(spec, Loaded):
        return loaded_again(spec, seed=spec.meaning.seed, overrides=overrides)
    return load_source(Source.read(design_file(Path(spec))), seed=seed, overrides=overrides)


def require_own_world(loaded: Loaded) -> None:
    """Raise EnvironmentNotImported for a spec whose world is stepped in Python, before its episodes are needed.

    Verbs that run episodes and import nothing call it, since others that they call would import what the user's
    configuration file allows.
    """
    outside = loaded.spec.environment.outside
    if outside is not None:
        from bbsd.environments.stepping import not_imported

        raise not_imported(outside)


def check(spec: str | Path) -> tuple[Diagnosis, ...]:
    """Return all mistakes of a spec, none if it is correct.

    Raises:
        OSError: its file cannot be read.
    """
    try:
        return check_source(Source.read(str(spec)))
    except SpecError as error:
        return error.diagnoses
