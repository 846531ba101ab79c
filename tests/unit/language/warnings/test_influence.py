from bbsd.language.loading import check
from tests.unit.language.specs import source

SET_AGAIN = (
    "environment: {dynamics: {height: height + speed, speed: 0}}\n"
    "reward: {effort: -abs(speed), near: 1 if abs(height) < 1 else 0}"
)


def told(part: str) -> list[str]:
    return [each.message for each in check(source(part), warnings=True) if each.code == "BB208"]


def test_of_a_command_that_dynamics_sets_again_it_is_told_why_the_reward_never_sees_it() -> None:
    assert told(SET_AGAIN) == [
        (
            "no behavior can change what effort adds up to: "
            "dynamics has set speed again by then, whatever an action set it to"
        )
    ]


def test_what_dynamics_sets_from_a_command_is_seen() -> None:
    part = SET_AGAIN.replace("speed: 0", "speed: 0, pace: speed").replace("abs(speed)", "abs(pace)")
    assert told(part.replace("environment: {", "environment: {state: {pace: 0}, ")) == []


def test_a_term_of_the_world_alone_has_no_such_cause() -> None:
    part = "environment: {world: {wind: 0}, dynamics: {wind: wind + 1}}\nreward: {calm: -abs(wind)}"
    assert told(part) == ["no behavior can change what calm adds up to"]
