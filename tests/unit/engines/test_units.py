import json
import pickle
from hashlib import sha256

import pytest

from bbsd.engines.units import VERSION, DamagedBytes, OtherVersion, Result, Unit, do

UNIT = Unit(
    name="run 2", work=f"{__name__}:turn_round", order={"seed": 3}, files={"a": b"abc", "b": b""}, seconds=0.5
)


def turn_round(unit):
    return Result(
        {name: content[::-1] for name, content in unit.files.items()}, finished=unit.order["seed"] > 2
    )


def test_a_unit_and_a_result_are_what_they_were_after_being_bytes():
    assert Unit.from_bytes(UNIT.to_bytes()) == UNIT
    for finished in (True, False):
        result = Result({"x": bytes(range(256)), "empty": b""}, finished)
        assert Result.from_bytes(result.to_bytes()) == result


def test_the_same_unit_is_the_same_bytes():
    assert UNIT.to_bytes() == Unit.from_bytes(UNIT.to_bytes()).to_bytes()


def test_a_unit_goes_on_from_other_files():
    further = UNIT.going_on_from({"a": b"d"})
    assert further.files == {"a": b"d"}
    assert (further.name, further.order) == (UNIT.name, UNIT.order)


def test_any_byte_that_is_not_what_was_sent_is_noticed():
    content = Result({"x": b"some bytes"}).to_bytes()
    for index in range(len(content)):
        damaged = bytearray(content)
        damaged[index] ^= 1
        with pytest.raises(DamagedBytes):
            Result.from_bytes(bytes(damaged))
    with pytest.raises(DamagedBytes):
        Result.from_bytes(content[:-1])


def test_a_unit_is_done_by_the_function_that_it_names(monkeypatch):
    monkeypatch.setattr("bbsd.engines.units.import_module", lambda _name: __import__("sys").modules[__name__])
    assert Result.from_bytes(do(UNIT.to_bytes())) == Result({"a": b"cba", "b": b""})


def test_a_worker_of_another_version_refuses():
    content = UNIT.to_bytes()[32:]
    end = 8 + int.from_bytes(content[:8], "big")
    head = json.loads(content[8:end])
    assert head["version"] == VERSION
    text = json.dumps({**head, "version": "bbsd 0.0.9, revision 1", "new": "key"}).encode()
    other = len(text).to_bytes(8, "big") + text + content[end:]
    with pytest.raises(
        OtherVersion, match=r"a worker has bbsd .* and this is bbsd 0\.0\.9, revision 1"
    ) as raised:
        do(sha256(other).digest() + other)
    assert "install the same version" in raised.value.advice


def test_errors_of_workers_can_be_sent():
    error = pickle.loads(pickle.dumps(OtherVersion("one", "other")))
    assert error.versions == ("one", "other")
