from bbsd.errors import did_you_mean


def test_a_near_name_is_suggested() -> None:
    assert did_you_mean("modlues", ["behaviors", "modules"]) == '; did you mean "modules"?'


def test_nothing_is_suggested_where_nothing_is_near() -> None:
    assert did_you_mean("reward", ["structure", "x"]) == ""


def test_nothing_is_suggested_among_no_names() -> None:
    assert did_you_mean("reward", iter(())) == ""


def test_a_very_long_word_is_not_compared() -> None:
    assert did_you_mean("a" * 1000, ["a" * 1001]) == ""


def test_an_abbreviation_is_suggested_where_no_spelling_is_near() -> None:
    assert did_you_mean("delta_t", ["radius", "dt"]) == '; did you mean "dt"?'
    assert did_you_mean("ts", ["top_speed", "goal"]) == '; did you mean "top_speed"?'
    assert did_you_mean("dt", ["delta", "goal"]) == ""


def test_among_many_names_those_that_begin_or_end_alike_are_compared() -> None:
    many = [f"sensor_{place}" for place in range(5000)]
    assert did_you_mean("hight", [*many, "height"]) == '; did you mean "height"?'
    assert did_you_mean("sensor_x", many) != ""
    assert did_you_mean("qqq", many) == ""
