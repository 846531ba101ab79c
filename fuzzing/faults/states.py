"""Checkpoints that are damaged, cut, exchanged and forged: each is told, and costs no more than an interval."""

from __future__ import annotations

import io
import json
import random
import resource
import shutil
import zipfile
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import numpy as np

from fuzzing.faults.commands import METHODS, NEWEST, PREVIOUS, command, design, difference, written
from fuzzing.faults.system import System

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

DIGEST_BYTES = 32
LENGTHS = 60
"""Lengths to which a checkpoint is cut."""
TABLES = ("census.", "culture.", "champions.")
MOST_MEGABYTES = 60
"""What reading a forged checkpoint may add to a process's peak of memory."""


def try_states(spec: Path, folder: Path, whole_resumes: int, seed: int) -> Iterator[tuple[str, str]]:
    """Yield what was done to checkpoints of each method, and what went wrong."""
    for method, settings in METHODS.items():
        place = folder / f"states-{method}"
        place.mkdir()
        out = place / "whole"
        ended = command(*design(spec, out, settings))
        yield f"{method}, not disturbed", "" if ended.code == 0 else str(ended)
        yield _every_byte(method, out)
        yield from _resumed(method, spec, out, place, whole_resumes, seed)
        yield from _strangers(method, spec, out, place)
        shutil.rmtree(place)


def _every_byte(method: str, out: Path) -> tuple[str, str]:
    """Flip each byte, and cut to each length, of a checkpoint, and read it in this process."""
    from bbsd.runs.storage.checkpoint import CheckpointError, unpacked

    whole, who = (out / "run-1" / NEWEST).read_bytes(), _Anybody()
    unpacked(whole, who, "whole")  # type: ignore[arg-type]
    accepted = []
    for index in range(len(whole)):
        for damaged in (
            whole[:index] + bytes([whole[index] ^ 1 << index % 8]) + whole[index + 1 :],
            whole[:index],
        ):
            try:
                unpacked(damaged, who, "damaged")  # type: ignore[arg-type]
            except CheckpointError:
                continue
            accepted.append(index)
    name = f"{method}: each of {len(whole)} bytes flipped, and each shorter length"
    return name, f"accepted at {accepted[:5]}" if accepted else ""


class _Anybody:
    """An identity that differs from none."""

    @staticmethod
    def differences(_content: object) -> list[str]:
        return []


def _resumed(
    method: str, spec: Path, whole: Path, place: Path, count: int, seed: int
) -> Iterator[tuple[str, str]]:
    """Resume designs with a damaged newest state: the one before it is taken, to the same bytes."""
    dice, expected = random.Random(seed), written(whole)
    content = (whole / "run-2" / NEWEST).read_bytes()
    lengths = [*range(0, 40, 8), *(dice.randrange(len(content)) for _ in range(LENGTHS - 5))]
    damages = [("flipped at", dice.randrange(len(content))) for _ in range(count)]
    damages += [("cut to", length) for length in lengths[: max(2, count)]]
    for what, index in damages:
        out = place / "damaged"
        shutil.rmtree(out, ignore_errors=True)
        shutil.copytree(whole, out)
        (out / "architecture.yaml").unlink()
        flipped = content[:index] + bytes([content[index] ^ 255]) + content[index + 1 :]
        (out / "run-2" / NEWEST).write_bytes(flipped if what == "flipped at" else content[:index])
        ended = command(*design(spec, out, METHODS[method], "--resume"))
        files = difference(written(out), expected)
        wrong = str(ended) if ended.code else files and f"wrong are {files}"
        yield f"{method}: a checkpoint {what} byte {index}, resumed", wrong


def _strangers(method: str, spec: Path, whole: Path, place: Path) -> Iterator[tuple[str, str]]:
    """Put states of others and forged ones in the place of all states: each is refused in words."""
    begun = _begun(method, spec, place)
    content, expected = (begun / "run-1" / NEWEST).read_bytes(), written(whole)
    others = {"run": (whole / "run-2" / NEWEST).read_bytes()}
    for what, more in {
        "seed": ("--seed", "2"),
        "spec": ("--set", "environment.steps=3"),
        "number of runs": ("--runs", "3"),
    }.items():
        out = place / "other"
        ended = command(*design(spec, out, METHODS[method], *more))
        if ended.code:
            yield f"{method}: a design of another {what}", str(ended)
        others[what] = (out / "run-1" / NEWEST).read_bytes()
        shutil.rmtree(out)
    forged = {f"of another {what}": other for what, other in others.items()}
    forged["of another revision"] = _with_identity(content, revision=10**6)
    forged["that inflates"] = _inflating()
    forged |= dict(_forged(content))
    for what, state in forged.items():
        out = place / "forged"
        shutil.rmtree(out, ignore_errors=True)
        shutil.copytree(begun, out)
        for name in (NEWEST, PREVIOUS):
            (out / "run-1" / name).write_bytes(state)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        ended = command(*design(spec, out, METHODS[method], "--resume"))
        grown = (resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss - before) / 1024
        wrong = "" if ended.is_refusal and "remove the folder" in ended.err else str(ended)
        if ended.code == 0:  # what was changed means the same, such as a number that has dimensions
            files = difference(written(out), expected)
            wrong = files and f"resumed with exit code 0, and wrong are {files}"
        if not wrong and grown > MOST_MEGABYTES:
            wrong = f"{grown:.0f} MB of memory"
        yield f"{method}: a checkpoint {what}", wrong


def _begun(method: str, spec: Path, place: Path) -> Path:
    """Return the folder of a design that was killed in its first run, after some steps."""
    out, log, counted = place / "begun", place / "calls", place / "counted"
    every = System(counted, log=log)
    command(*design(spec, counted, METHODS[method]), before=lambda: _begin(every))
    calls = log.read_text(encoding="utf-8").splitlines()
    shutil.rmtree(counted)
    saved = [number for number, call in enumerate(calls, start=1) if call.startswith("replace .checkpoint")]
    killing = System(out, "kill", saved[len(saved) // 4] + 1)
    command(*design(spec, out, METHODS[method]), before=lambda: _begin(killing))
    return out


def _begin(system: System) -> None:
    from bbsd.runs.storage import records

    records.INTERVAL = 0.0
    system.install()


def _arrays(content: bytes) -> dict[str, Any]:
    return dict(np.load(io.BytesIO(content[DIGEST_BYTES:]), allow_pickle=False))


def _packed(arrays: dict[str, Any], *, compressed: bool = False) -> bytes:
    buffer = io.BytesIO()
    (np.savez_compressed if compressed else np.savez)(buffer, **arrays)
    return sha256(buffer.getvalue()).digest() + buffer.getvalue()


def _with_identity(content: bytes, **changed: object) -> bytes:
    arrays = _arrays(content)
    who = json.loads(arrays["identity"].tobytes()) | changed
    return _packed({**arrays, "identity": np.frombuffer(json.dumps(who).encode(), np.uint8)})


def _inflating() -> bytes:
    """Return a small file that inflates to 400 MB."""
    buffer = io.BytesIO()
    with (
        zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive,
        archive.open("identity.npy", "w") as file,
    ):
        for _ in range(400):
            file.write(bytes(1_000_000))
    return sha256(buffer.getvalue()).digest() + buffer.getvalue()


def _forged(content: bytes) -> Iterator[tuple[str, bytes]]:
    """Yield states in which one array is of another shape or type, out of range, or missing; the digest is right."""
    arrays = _arrays(content)
    for name, array in arrays.items():
        if name == "identity":
            continue
        if not name.startswith(TABLES):  # a state from before the first line of a table lacks them
            yield f"without {name}", _packed({key: each for key, each in arrays.items() if key != name})
        yield f"with {name} of more dimensions", _packed({**arrays, name: array[None, None]})
        yield f"with {name} as text", _packed({**arrays, name: np.array(["x"] * max(1, array.size))})
        if array.ndim and array.shape[0] and not name.endswith("pools"):  # a smaller population is one too
            yield f"with {name} cut", _packed({**arrays, name: array[:-1]})
