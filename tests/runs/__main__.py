"""`python -m tests.runs`: make the folders of runs that every later version must read, by this version.

It is run once for each version and revision; what is there already is never made anew.
"""

import json
import shutil
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory

import bbsd
from bbsd.api import Interrupted
from bbsd.runs.storage import records
from bbsd.version import REVISION, __version__

HOME = Path(__file__).parent
SPEC = HOME.parent / "end_to_end" / "specs" / "thermostat.yaml"
SEED = 4
EPISODES = 50
STOPPED, FINISHED = "paper-stopped", "default-finished"
SETTINGS = {
    STOPPED: ("design.coevolution.generations=8",),
    FINISHED: ("design.method=auto", "design.budget=6000"),
}


def folder_of_this_version() -> Path:
    """Return the folder for the runs of this version and revision."""
    return HOME / f"{__version__}-revision-{REVISION}"


def make() -> None:
    """Design twice: to the end, and by the paper's loop until its fifth generation."""
    place = folder_of_this_version()
    place.mkdir()
    records.INTERVAL = 0.0  # the state is saved after each generation
    expected = {}
    with TemporaryDirectory() as elsewhere:
        for name, settings in SETTINGS.items():
            whole = bbsd.design(SPEC, seed=SEED, set=settings, out=Path(elsewhere) / name)
            expected[name] = {
                "seed": SEED,
                "set": settings,
                "architecture_sha256": sha256(whole.architecture.read_bytes()).hexdigest(),
                "metrics_sha256": sha256((whole.folder / "metrics.jsonl").read_bytes()).hexdigest(),
                "mean_return": bbsd.evaluate(whole.architecture, episodes=EPISODES).mean,
            }
        shutil.copytree(Path(elsewhere) / FINISHED, place / FINISHED)
    try:
        bbsd.design(SPEC, seed=SEED, set=SETTINGS[STOPPED], out=place / STOPPED, progress=_stop_in_the_middle)
    except Interrupted:
        (place / "expected.json").write_text(json.dumps(expected, indent=2) + "\n", encoding="utf-8")


def _stop_in_the_middle(progress: object) -> None:
    if getattr(progress, "generation", 0) == 5:
        raise KeyboardInterrupt


if __name__ == "__main__":
    make()
