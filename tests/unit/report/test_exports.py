from bbsd.api.exporting import Export
from bbsd.exports.verification.comparing import Difference, Verified
from bbsd.report.exports import verified_lines


def verified(**changes):
    found = {
        "tool": "gcc",
        "needed": True,
        "missing": False,
        "failure": "",
        "compared": 160,
        "equal": 160,
        "is_proof": True,
        "joint_size": 160,
        "first_difference": None,
    }
    return Verified(**{**found, **changes})


def lines(*found):
    return verified_lines(Export("name", "digest", "c", {"name.h": ""}, found))


def test_each_tool_has_a_line():
    assert lines(verified(), verified(tool="micropython", missing=True, needed=False)) == [
        "gcc: 160 of 160 cells equal",
        "micropython was not found: not verified",
    ]
    assert lines(verified(failure="gcc failed\x1b")) == ["gcc: not verified: gcc failed\\x1b"]
    assert lines() == ["nothing here runs c: not verified"]


def test_tested_and_proven_are_different_words():
    large = verified(compared=211_000, equal=211_000, is_proof=False, joint_size=20_000_000)
    assert lines(large) == ["gcc: 211,000 of 211,000 cells equal (tested, not proven: there are 20,000,000)"]
    huge = verified(is_proof=False, joint_size=10**400)
    assert lines(huge) == ["gcc: 160 of 160 cells equal (tested, not proven: there are about 10^400)"]


def test_the_first_cell_that_differs_is_shown():
    difference = Difference((("pace", "5"), ("tilted", "true")), "cap of slow", "nobody")
    assert lines(verified(equal=159, first_difference=difference)) == [
        "gcc: 159 of 160 cells equal",
        "  where pace 5, tilted true: the design decides cap of slow, gcc nobody",
    ]


def test_it_is_verified_if_all_that_ran_agree_and_all_that_is_needed_ran():
    def is_verified(*found):
        return Export("name", "digest", "c", {}, found).is_verified

    optional = {"tool": "micropython", "needed": False}
    assert is_verified(verified(), verified(missing=True, equal=0, **optional))
    assert not is_verified(verified(), verified(equal=3, **optional))
    assert not is_verified(verified(), verified(failure="no", equal=0, **optional))
    assert not is_verified(verified(missing=True, equal=0))
    assert not is_verified()
