from bbsd.expression.nesting import by_name, lengths_of

LENGTHS = {"x": (), "grid": (2, 2), "w": (3,)}


def test_values_of_a_list_are_nested_in_their_order():
    variables = [("x", ()), ("grid", (0, 0)), ("grid", (0, 1)), ("grid", (1, 0)), ("grid", (1, 1))]
    assert by_name(variables, [9, 1, 2, 3, 4], LENGTHS, list) == {"x": 9, "grid": [[1, 2], [3, 4]]}


def test_elements_of_a_list_that_is_not_whole_stand_alone():
    assert by_name([("w", (1,)), ("w", (2,))], [5, 6], LENGTHS, list) == {"w[1]": 5, "w[2]": 6}


def test_the_first_elements_of_a_list_are_not_taken_for_all_of_it():
    assert by_name([("w", (0,)), ("w", (1,))], [5, 6], LENGTHS, list) == {"w[0]": 5, "w[1]": 6}
    row = [("grid", (0, 0)), ("grid", (0, 1))]
    assert by_name(row, [5, 6], LENGTHS, list) == {"grid[0][0]": 5, "grid[0][1]": 6}


def test_lengths_are_those_of_the_lists_that_have_all_places():
    variables = [("x", ()), *(("grid", (row, column)) for row in range(2) for column in range(3))]
    assert lengths_of(variables) == {"x": (), "grid": (2, 3)}
