import errno
import json
import os
from dataclasses import fields, is_dataclass, replace
from hashlib import sha256
from io import BytesIO

import numpy as np
import pytest

from bbsd.architecture import Architecture
from bbsd.runs.storage import checkpoint, identity
from bbsd.runs.storage.checkpoint import CheckpointError
from bbsd.runs.storage.identity import Identity
from bbsd.runs.storage.state import RunState, restored_run, run_arrays
from bbsd.solver.paper.generation import initial_state, next_generation
from bbsd.version import REVISION
from tests.unit.solver.problems import guess


def progress(n_generations):
    problem, settings = guess()
    state = initial_state(problem, settings, 1)
    for _ in range(n_generations):
        state, _ = next_generation(state, problem, settings, 1)
    return RunState(0, state)


WHO = Identity((("environment", "a"), ("reward", "b")), 3, 2)


def save(path, reached, who=WHO):
    checkpoint.save(path, who, run_arrays(reached))


def load(path, run=0):
    problem, settings = guess()
    return restored_run(
        checkpoint.load(path, WHO), RunState(run, initial_state(problem, settings, 1)), problem
    )


def leaves(value):
    """Every array and number in a value, in order."""
    if is_dataclass(value):
        return [leaf for field in fields(value) for leaf in leaves(getattr(value, field.name))]
    if value is None:
        return []
    if isinstance(value, tuple):
        return [leaf for item in value for leaf in leaves(item)]
    return [np.asarray(value)]


def assert_same(first, second):
    for one, other in zip(leaves(first), leaves(second), strict=True):
        assert one.dtype == other.dtype
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("n_generations", [0, 1, 3])
def test_what_is_saved_is_loaded(tmp_path, n_generations):
    before = progress(n_generations)
    save(tmp_path / "c", before)
    assert_same(load(tmp_path / "c"), before)


def test_an_answer_is_kept_with_the_state(tmp_path):
    tables = (np.array([1, 2, 0, 1], np.uint8), np.array([0, 0, 2, 0], np.uint8), np.array([1], np.uint8))
    before = replace(progress(1), run=2, answer=Architecture(tables, np.array([2, 1, 0])))
    save(tmp_path / "c", before)
    after = load(tmp_path / "c", run=2)
    assert_same(after, before)
    assert after.run == 2
    assert [table.tolist() for table in after.answer.tables] == [[1, 2, 0, 1], [0, 0, 2, 0], [1]]


def test_the_same_state_is_the_same_file(tmp_path):
    for name in ("a", "b"):
        save(tmp_path / name, progress(2))
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_a_checkpoint_is_replaced_whole(tmp_path):
    for n_generations in (0, 1):
        save(tmp_path / "c", progress(n_generations))
    assert [path.name for path in tmp_path.iterdir()] == ["c"]
    assert load(tmp_path / "c").state.generation == 1


def test_a_damaged_checkpoint_is_told_from_a_whole_one(tmp_path):
    path = tmp_path / "c"
    save(path, progress(1))
    whole = path.read_bytes()
    flipped = bytearray(whole)
    flipped[len(whole) // 2] ^= 1
    for damaged in (b"", whole[:20], whole[:32], whole[:-1], whole + b"x", bytes(flipped)):
        path.write_bytes(damaged)
        with pytest.raises(CheckpointError, match="damaged"):
            load(path)


def archive(**arrays):
    buffer = BytesIO()
    np.savez(buffer, **arrays)
    return buffer.getvalue()


def compressed():
    buffer = BytesIO()
    np.savez_compressed(buffer, identity=identity_of(WHO), zeros=np.zeros(10_000_000, np.uint8))
    return buffer.getvalue()


def identity_of(who):
    return np.frombuffer(json.dumps(who.plain()).encode(), np.uint8)


def huge():
    """An array that says that it is larger than the file."""
    content = archive(identity=identity_of(WHO), zeros=np.zeros(100, np.uint8))
    return content.replace(b"'shape': (100,)", b"'shape': (999,)")


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"no archive",
        archive(run=np.array(1)),
        archive(identity=identity_of(WHO), run=np.array([{}], dtype=object)),
        archive(identity=np.zeros(3)),
        archive(identity=np.frombuffer(b"[1]", np.uint8)),
        compressed(),
        huge(),
    ],
    ids=["empty", "text", "incomplete", "pickled", "no identity", "another identity", "compressed", "huge"],
)
def test_what_is_no_state_is_refused(tmp_path, content):
    path = tmp_path / "c"
    path.write_bytes(sha256(content).digest() + content)
    with pytest.raises(CheckpointError, match="cannot be read"):
        load(path)


@pytest.mark.parametrize(
    ("other", "told"),
    [
        (replace(WHO, seed=4), "the seed \\(4, not 3\\)"),
        (replace(WHO, runs=1), "the number of runs \\(1, not 2\\)"),
        (replace(WHO, spec=(("environment", "x"), ("reward", "b"))), "the spec's environment"),
        (replace(WHO, spec=(("environment", "a"), ("structure", "c"))), "the spec's reward, structure"),
    ],
    ids=["seed", "runs", "a block", "blocks"],
)
def test_a_checkpoint_of_another_run_is_refused_with_what_differs(tmp_path, other, told):
    save(tmp_path / "c", progress(1), other)
    with pytest.raises(CheckpointError, match=f"is of another run: different are {told}"):
        load(tmp_path / "c")


def test_a_checkpoint_of_another_revision_is_not_resumed(tmp_path, monkeypatch):
    monkeypatch.setattr(identity, "REVISION", REVISION + 1)
    save(tmp_path / "c", progress(1))
    monkeypatch.undo()
    with pytest.raises(CheckpointError, match=rf"the revision \({REVISION + 1}, not {REVISION}\)"):
        load(tmp_path / "c")


def forged(**changed):
    """The arrays of a run, some of them others."""
    return {**run_arrays(progress(1)), **{name.replace("__", "."): array for name, array in changed.items()}}


@pytest.mark.parametrize(
    "changed",
    [
        {"state__pools__0": np.zeros((5, 3), np.uint8)},
        {"state__pools__0": np.full((5, 4), 200, np.uint8)},
        {"state__pools__0": np.zeros((5, 4), np.int64)},
        {"state__fitness": np.zeros((3, 4))},
        {"state__generation": np.array(77)},
        {"state__culture__memes": np.full((3, 3), 9)},
        {"state__culture__memes": np.zeros((3, 3), np.int64)},
        {"state__champions__tables": np.zeros((2, 9), np.uint8)},
        {"answer__tables": np.zeros(2, np.uint8), "answer__structure": np.array([2, 1, 0])},
        {"state__champions__fitness": np.zeros(1)},
        {"state__culture__fitness": np.zeros(77)},
        {"run": np.array(1)},
    ],
    ids=str,
)
def test_arrays_that_a_run_of_the_spec_cannot_have_are_refused(tmp_path, changed):
    checkpoint.save(tmp_path / "c", WHO, forged(**changed))
    with pytest.raises(CheckpointError):
        load(tmp_path / "c")


def test_a_missing_array_is_refused(tmp_path):
    arrays = forged()
    del arrays["state.fitness"]
    checkpoint.save(tmp_path / "c", WHO, arrays)
    with pytest.raises(CheckpointError, match=r"state\.fitness is missing"):
        load(tmp_path / "c")


def test_every_flipped_byte_is_detected(tmp_path):
    path = tmp_path / "c"
    save(path, progress(1))
    whole = path.read_bytes()
    for index in range(0, len(whole), 7):
        path.write_bytes(whole[:index] + bytes([whole[index] ^ 16]) + whole[index + 1 :])
        with pytest.raises(CheckpointError):
            load(path)


def test_a_disk_that_fails_is_no_damaged_state(tmp_path, monkeypatch):
    def failing(path, most=-1):
        raise OSError(errno.EIO, os.strerror(errno.EIO), str(path))

    monkeypatch.setattr(checkpoint, "read_regular", failing)
    with pytest.raises(OSError, match="Input/output error"):
        checkpoint.load(tmp_path / "checkpoint.npz", WHO)
