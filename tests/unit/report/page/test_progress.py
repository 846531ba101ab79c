"""Curves of a run: means over runs, and their spread."""

from bbsd.report.page.progress import curves_plain


def test_a_run_keeps_its_value_until_the_next():
    metrics = [
        {"run": 1, "episodes": 10, "mean": 1.0},
        {"run": 1, "episodes": 30, "mean": 3.0},
        {"run": 2, "episodes": 20, "mean": 5.0},
    ]
    curves = curves_plain(metrics)
    assert curves["x"] == [10, 20, 30]
    assert curves["label"] == "episodes"
    assert curves["runs"] == 2
    assert curves["lines"] == [
        {"name": "best so far", "mean": [1, 3, 4], "low": [1, 1, 3], "high": [1, 5, 5]}
    ]


def test_generations_have_three_curves():
    lines = [
        {"run": 1, "generation": number, "mean": number, "best": 2 * number, "lifetime": 0}
        for number in (1, 2)
    ]
    curves = curves_plain(lines)
    assert curves["label"] == "generation"
    assert [line["mean"] for line in curves["lines"]] == [[1, 2], [2, 4], [0, 0]]


def test_without_metrics_there_are_no_curves():
    assert curves_plain([]) is None
