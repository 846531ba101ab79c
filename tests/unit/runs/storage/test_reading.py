import pytest

from bbsd.runs.storage.reading import FORMS, are_metrics, is_line, is_whole, plain_data, run_record

LINE = {"run": 1, "generation": 2, "mean": 0.5, "structure": ["push"], "diversity": {"push": 0.5}}


def test_a_line_of_metrics_is_one():
    assert is_line(LINE)


@pytest.mark.parametrize(
    "changed",
    [
        {"run": "1"}, {"run": True}, {"run": 10**400}, {"mean": None}, {"mean": [1.0]}, {"structure": "push"},
        {"structure": [1]}, {"generation": 1.5}, {"diversity": []}, {"diversity": {"push": "x"}},
    ],
    ids=str,
)  # fmt: skip
def test_a_line_with_another_type_is_none(changed):
    assert not is_line(LINE | changed)


@pytest.mark.parametrize("value", [None, [], "x", 3, {}, {"run": 1}], ids=str)
def test_other_values_are_no_lines(value):
    assert not is_line(value)


def test_metrics_are_all_of_one_form():
    values = {"run": 1, "mean": 0.5, "structure": [], "diversity": {}, "method": "auto", "stage": "search"}
    generation, search = ({key: values.get(key, 2) for key in form} for form in FORMS)
    assert are_metrics([])
    assert are_metrics([generation, generation])
    assert are_metrics([search])
    assert not are_metrics([generation, search])
    assert not are_metrics([search, None])


def test_what_is_nested_without_end_is_no_data():
    with pytest.raises(ValueError, match="nested too deep"):
        plain_data(b"[" * 100_000)


def test_a_record_is_read_without_what_has_another_type():
    assert run_record('{"seed": "1", "runs": 2, "set": {}, "versions": 3, "budgets": 7, "more": []}') == {
        "runs": 2,
        "budgets": 7,
        "more": [],
    }
    assert run_record("[1]") == {}


def test_truth_values_are_no_whole_numbers():
    assert is_whole(3)
    assert not is_whole(True)
    assert not is_whole(3.0)
