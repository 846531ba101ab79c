from tests.unit.language.specs import codes


def reached(environment: str, values: str) -> list[str]:
    return codes(f'environment: {environment}\nbehaviors: {{stop: {{inputs: {{reached: "{values}"}}}}}}')


def test_a_slot_is_whole_where_it_starts_so_and_every_step_keeps_it_so() -> None:
    assert reached("{state: {n: 0}, dynamics: {n: n + 1}}", "values(n, 0, 5)") == []
    assert reached("{state: {n: 0}, dynamics: {n: n + 0.5}}", "values(n, 0, 5)") == ["BB064"]
    assert reached("{state: {n: 0.5}}", "values(n, 0, 5)") == ["BB064"]
    assert (
        reached(
            "{state: {n: 'integers(0, 3)', m: n}, dynamics: {n: m, m: 'min(n, 4) % 3'}}", "values(m, 0, 5)"
        )
        == []
    )


def test_a_fraction_spreads_from_slot_to_slot() -> None:
    states = ", ".join(f"m{index}: 0" for index in range(20))
    dynamics = ", ".join(["m0: m0 + 0.5", *(f"m{index}: m{index - 1}" for index in range(1, 20))])
    assert reached(f"{{state: {{{states}}}, dynamics: {{{dynamics}}}}}", "values(m19, 0, 5)") == ["BB064"]


def test_what_an_action_sets_counts() -> None:
    part = 'behaviors: {stop: {inputs: {reached: "values(speed, 0, 5)"}, actions: {halt: {speed: %s}}}}'
    assert codes(part % "speed + 1") == []
    assert codes(part % "speed / 2") == ["BB064"]


def test_sensors_and_constants_are_whole_if_what_they_are_made_of_is() -> None:
    assert reached("{sensors: {pace: floor(height) + speed}}", "values(pace, 0, 5)") == []
    assert reached("{sensors: {pace: height}}", "values(pace, 0, 5)") == ["BB064"]
    part = 'constants: {table: %s}\nbehaviors: {stop: {inputs: {reached: "values(table[speed], 0, 5)"}}}'
    assert codes(part % "[1, 2, 3]") == []
    assert codes(part % "[1, 2.5, 3]") == ["BB064"]
