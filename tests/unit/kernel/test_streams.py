import math
import statistics
from collections.abc import Callable, Iterator
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.kernel import streams
from bbsd.kernel.modules import load_kernel

WORDS = st.integers(0, 2**64 - 1)
KEY = streams.name_word("a key")
DRAWS = 20_000

SOURCE = """
import numpy as np
from bbsd.kernel.functions import select
from bbsd.kernel.streams import chance, fold, integers, mix64, normal, uniform, unit, word_of

def draw(keys, words, floats, step):
    folded = words[0:40]
    mixed = words[40:80]
    for lane in range(40):
        key = word_of(keys[lane])
        folded[lane] = fold(key, word_of(step))
        mixed[lane] = mix64(key)
    units = floats[0:40]
    uniforms = floats[40:80]
    wholes = floats[80:120]
    chances = floats[120:160]
    for lane in range(40):
        key = word_of(keys[lane])
        word = word_of(step)
        units[lane] = unit(key)
        uniforms[lane] = uniform(key, word, -2.0, 3.5)
        wholes[lane] = integers(key, word, 1.0, 6.0)
        chances[lane] = select(chance(key, word, 0.3), 1.0, 0.0)

def draw_normal(keys, floats, step):
    normals = floats[0:40]
    for lane in range(40):
        normals[lane] = normal(word_of(keys[lane]), word_of(step), 10.0, 2.0)
"""


def splitmix64(seed: int) -> Iterator[int]:
    """Yield the numbers of the generator as published (Steele, Lea and Flood 2014), in modular arithmetic."""
    state = seed
    while True:
        state = (state + 11400714819323198485) % 2**64
        z = state
        z = (z ^ z // 2**30) * 13787848793156543929 % 2**64
        z = (z ^ z // 2**27) * 10723151780598845931 % 2**64
        yield z ^ z // 2**31


def test_mixing_gives_the_published_numbers() -> None:
    published = [
        6457827717110365317,
        3203168211198807973,
        9817491932198370423,
        4593380528125082431,
        16408922859458223821,
    ]
    counters = [(1234567 + index * streams.GOLDEN) % 2**64 for index in range(1, 6)]
    assert [streams.mix64(counter) for counter in counters] == published


@given(WORDS)
def test_mixing_is_splitmix64_s_finalizer(seed: int) -> None:
    assert streams.mix64((seed + streams.GOLDEN) % 2**64) == next(splitmix64(seed))


@given(WORDS, WORDS)
def test_folding_mixes_the_key_with_the_mixed_word(key: int, word: int) -> None:
    assert streams.fold(key, word) == streams.mix64(key ^ next(splitmix64(word)))


@given(WORDS)
def test_a_unit_is_below_one_and_keeps_the_highest_53_bits(bits: int) -> None:
    assert 0.0 <= streams.unit(bits) < 1.0
    assert streams.unit(bits) * 2**53 == bits // 2**11


def test_streams_do_not_collide() -> None:
    keys = [
        streams.fold(streams.fold(KEY, generation), agent)
        for generation in range(150)
        for agent in range(200)
    ]
    assert len(set(keys)) == len(keys)


def test_folding_does_not_commute() -> None:
    assert streams.fold(streams.fold(KEY, 1), 2) != streams.fold(streams.fold(KEY, 2), 1)


def test_one_bit_of_the_word_changes_half_of_the_key() -> None:
    changed = [
        (streams.fold(KEY, word) ^ streams.fold(KEY, word ^ 1 << bit)).bit_count()
        for word in range(50)
        for bit in range(64)
    ]
    assert statistics.mean(changed) == pytest.approx(32, abs=0.3)


def test_names_are_words_of_their_own() -> None:
    assert streams.name_word("goal") != streams.name_word("Goal")
    assert 0 <= streams.name_word("goal") < 2**64


@given(st.integers(-(2**63), 2**63 - 1))
def test_a_whole_number_s_word_is_its_twos_complement(number: int) -> None:
    assert streams.word_of(number) == number % 2**64
    assert streams.word_of(int(np.int64(number))) == number % 2**64


def test_uniform_draws_fill_the_interval_evenly() -> None:
    draws = [streams.uniform(KEY, word, -2.0, 3.0) for word in range(DRAWS)]
    counts, _ = np.histogram(draws, bins=50, range=(-2.0, 3.0))
    assert counts.sum() == DRAWS
    assert ((counts - DRAWS / 50) ** 2 / (DRAWS / 50)).sum() < 85.4  # chi-square, 49 degrees, p = 0.001


def test_integers_reach_both_ends_evenly() -> None:
    draws = [streams.integers(KEY, word, 3.0, 8.0) for word in range(DRAWS)]
    values, counts = np.unique(draws, return_counts=True)
    assert values.tolist() == [3, 4, 5, 6, 7, 8]
    assert ((counts - DRAWS / 6) ** 2 / (DRAWS / 6)).sum() < 20.5  # chi-square, 5 degrees, p = 0.001


def test_integers_of_an_empty_range_are_the_first() -> None:
    assert {streams.integers(KEY, word, 4.0, 2.0) for word in range(50)} == {4.0}


@pytest.mark.parametrize("probability", [0.0, 0.3, 1.0])
def test_chance_has_its_probability(probability: float) -> None:
    hits = sum(streams.chance(KEY, word, probability) for word in range(DRAWS))
    assert hits == pytest.approx(
        probability * DRAWS, abs=3.3 * math.sqrt(probability * (1 - probability) * DRAWS)
    )


def test_normal_draws_follow_the_gaussian() -> None:
    draws = sorted(streams.normal(KEY, word, 5.0, 2.0) for word in range(DRAWS))
    gaussian = statistics.NormalDist(5.0, 2.0)
    distance = max(abs(gaussian.cdf(draw) - rank / DRAWS) for rank, draw in enumerate(draws))
    assert distance < 1.95 / math.sqrt(DRAWS)  # Kolmogorov and Smirnov, p = 0.001


@pytest.fixture(scope="module")
def kernels(tmp_path_factory: pytest.TempPathFactory) -> Callable[[bool], ModuleType]:
    def load(compiled: bool) -> ModuleType:
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("BBSD_CACHE_DIR", str(tmp_path_factory.getbasetemp() / "streams"))
            return load_kernel(SOURCE, "draws", ("draw", "draw_normal"), compiled)

    return load


@pytest.mark.parametrize("step", [0, 1, 299, -1])
def test_compiled_draws_are_the_plain_ones(kernels: Callable[[bool], ModuleType], step: int) -> None:
    keys = np.array([streams.fold(KEY, lane) for lane in range(40)], dtype=np.uint64)
    results = []
    for compiled in (False, True):
        words, floats, normals = np.zeros(80, np.uint64), np.zeros(160), np.zeros(40)
        kernels(compiled).draw(keys, words, floats, step)
        kernels(compiled).draw_normal(keys, normals, step)
        results.append((words, floats, normals))
    for plain, compiled_result in zip(*results, strict=True):
        np.testing.assert_array_equal(plain, compiled_result)


def test_draws_of_all_lanes_are_vectorized(kernels: Callable[[bool], ModuleType]) -> None:
    keys = np.arange(40, dtype=np.uint64)
    kernels(True).draw(keys, np.zeros(80, np.uint64), np.zeros(160), 1)
    kernels(True).draw_normal(keys, np.zeros(40), 1)
    (code,) = kernels(True).draw.inspect_llvm().values()
    (normal_code,) = kernels(True).draw_normal.inspect_llvm().values()
    assert "x i64>" in code
    assert "x double>" in normal_code
