from bbsd.expression.nesting import by_name, lengths_of


def test_values_of_a_list_are_nested_in_their_order():
    variables = [("x", ()), ("grid", (0, 0)), ("grid", (0, 1)), ("grid", (1, 0)), ("grid", (1, 1))]
    assert by_name(variables, [9, 1, 2, 3, 4], list) == {"x": 9, "grid": [[1, 2], [3, 4]]}


def test_elements_of_a_list_that_is_not_whole_stand_alone():
    assert by_name([("w", (1,)), ("w", (2,))], [5, 6], list) == {"w[1]": 5, "w[2]": 6}


def test_lengths_are_those_of_lists_that_have_these_places_and_no_others():
    assert lengths_of({(): 1}) == ()
    assert lengths_of({(0, 0): 1, (0, 1): 2}) == (1, 2)
    assert lengths_of({(0, 0): 1, (1, 1): 2}) is None
