from dataclasses import fields, is_dataclass, replace
from hashlib import sha256
from io import BytesIO

import numpy as np
import pytest

from bbsd.architecture import Architecture
from bbsd.runs import checkpoint
from bbsd.runs.checkpoint import CheckpointError, RunState
from bbsd.solver.generation import initial_state, next_generation
from bbsd.version import REVISION
from tests.unit.solver.problems import guess


def progress(n_generations):
    problem, settings = guess()
    state = initial_state(problem, settings, 1)
    for _ in range(n_generations):
        state, _ = next_generation(state, problem, settings, 1)
    return RunState(0, state)


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
    checkpoint.save(tmp_path / "c", before)
    assert_same(checkpoint.load(tmp_path / "c"), before)


def test_an_answer_is_kept_with_the_state(tmp_path):
    tables = (np.array([1, 2, 0, 1], np.uint8), np.array([0, 0, 2, 0], np.uint8), np.array([1], np.uint8))
    before = replace(progress(1), run=2, answer=Architecture(tables, np.array([2, 1, 0])))
    checkpoint.save(tmp_path / "c", before)
    after = checkpoint.load(tmp_path / "c")
    assert_same(after, before)
    assert after.run == 2
    assert [table.tolist() for table in after.answer.tables] == [[1, 2, 0, 1], [0, 0, 2, 0], [1]]


def test_the_same_state_is_the_same_file(tmp_path):
    for name in ("a", "b"):
        checkpoint.save(tmp_path / name, progress(2))
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_a_checkpoint_is_replaced_whole(tmp_path):
    for n_generations in (0, 1):
        checkpoint.save(tmp_path / "c", progress(n_generations))
    assert [path.name for path in tmp_path.iterdir()] == ["c"]
    assert checkpoint.load(tmp_path / "c").state.generation == 1


def test_a_damaged_checkpoint_is_told_from_a_whole_one(tmp_path):
    path = tmp_path / "c"
    checkpoint.save(path, progress(1))
    whole = path.read_bytes()
    flipped = bytearray(whole)
    flipped[len(whole) // 2] ^= 1
    for damaged in (b"", whole[:20], whole[:32], whole[:-1], whole + b"x", bytes(flipped)):
        path.write_bytes(damaged)
        with pytest.raises(CheckpointError, match="damaged"):
            checkpoint.load(path)


def archive(**arrays):
    buffer = BytesIO()
    np.savez(buffer, **arrays)
    return buffer.getvalue()


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"no archive",
        archive(run=np.array(1)),
        archive(run=np.array([{}], dtype=object)),
        archive(fitness=np.zeros((2, 3)), pool_0=np.zeros(2), pool_1=np.zeros(2)),
    ],
    ids=["empty", "text", "incomplete", "pickled", "in part"],
)
def test_what_is_no_state_is_refused(tmp_path, content):
    path = tmp_path / "c"
    path.write_bytes(sha256(content).digest() + content)
    with pytest.raises(CheckpointError, match="cannot be read"):
        checkpoint.load(path)


def test_a_checkpoint_of_another_revision_is_not_resumed(tmp_path, monkeypatch):
    monkeypatch.setattr(checkpoint, "REVISION", REVISION + 1)
    checkpoint.save(tmp_path / "c", progress(1))
    monkeypatch.undo()
    with pytest.raises(
        CheckpointError, match=rf"by revision {REVISION + 1} of bbsd; this is revision {REVISION}"
    ):
        checkpoint.load(tmp_path / "c")
