"""The intervals of worth hold the truth about as often as they say."""

import pytest

from experiments.worth_coverage import coverages


@pytest.mark.slow
def test_95_percent_intervals_hold_the_truth():
    found = coverages()
    assert {*found} == {"dropped behaviors", "dropped rules", "random tables"}
    for kind, coverage in found.items():
        assert coverage.of >= 800, kind
        assert 0.9 <= coverage.share <= 0.98, kind
