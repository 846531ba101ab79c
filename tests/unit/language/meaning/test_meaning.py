from bbsd.language.meaning import seed_key
from tests.unit.language.specs import meaning_of


def test_seeds_have_keys_of_their_own() -> None:
    assert len({seed_key(seed) for seed in range(1000)}) == 1000


def test_the_meaning_says_for_which_seed_it_holds() -> None:
    assert meaning_of(seed=7).seed == 7
