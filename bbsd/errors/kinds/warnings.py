"""The kinds of warnings, from BB201 on: what can be used, but probably does not say what its author meant."""

from __future__ import annotations

from bbsd.errors.kinds.kind import DiagnosisKind, Severity


def _warning(code: str, title: str, explanation: str, example: str, mend: str) -> DiagnosisKind:
    return DiagnosisKind(code, title, explanation, example, mend, Severity.WARNING)


WARNING_KINDS = (
    _warning(
        code="BB201",
        title="a name that nothing uses",
        explanation=(
            "A constant, world, state, definition or sensor matters only where the reward, an end, a behavior, an "
            "expectation, the view or the design comes to use it, perhaps by way of other names. What is only computed "
            "from its own last value, or used by names that nothing uses, does not count. Often another name stands "
            "where this one was meant."
        ),
        example=(
            "constants:\n  goal: 3\nbehaviors:\n  stop:\n    inputs:\n      reached: height >= 3      # goal was meant"
        ),
        mend="constants:\n  goal: 3\nbehaviors:\n  stop:\n    inputs:\n      reached: height >= goal",
    ),
    _warning(
        code="BB202",
        title="state or world that never changes",
        explanation=(
            "Neither dynamics nor an action sets it, and it starts with the same value in every episode and for every "
            "robot. Perhaps its dynamics were forgotten; else it is a constant. A start that is drawn, or that depends "
            "on robot, is no constant."
        ),
        example=("environment:\n  world:\n    wind: 1\n  dynamics:\n    height: height + speed + wind"),
        mend=(
            "environment:\n  world:\n    wind: 1\n  dynamics:\n    height: height + speed + wind\n"
            "    wind: wind + normal(0, 1)"
        ),
    ),
    _warning(
        code="BB203",
        title="an action that changes nothing",
        explanation=(
            "A state is set to the value that it has, or its dynamics compute it without regard to what actions set. "
            "What an action does not set stays, so that an action that only keeps layers below from acting sets "
            "nothing. Beside actions that change the state, keep: {speed: speed} is not reported: it says that the "
            "state stays. Where there is one behavior, such an action is the same as no action."
        ),
        example="behaviors:\n  stop:\n    actions:\n      halt: {speed: speed}",
        mend="behaviors:\n  stop:\n    actions:\n      halt: {speed: 0}",
    ),
    _warning(
        code="BB204",
        title="two actions that do the same",
        explanation=(
            "Two actions of a behavior set the same state to the same values. A design that uses one is as good as a "
            "design that uses the other, and the search is larger for nothing; often one of them was copied and not "
            "changed."
        ),
        example="behaviors:\n  stop:\n    actions:\n      halt: {speed: 0}\n      push: {speed: 0}",
        mend="behaviors:\n  stop:\n    actions:\n      halt: {speed: 0}\n      push: {speed: 1}",
    ),
    _warning(
        code="BB205",
        title="cells that no rule matches",
        explanation=(
            "Cells that no rule matches are open: bbsd design fills them, and a spec with them cannot be evaluated. "
            "Rules that leave cells open say so, by otherwise: open or do: open; where nothing is to be done in the "
            "other cells, they end with otherwise: no action."
        ),
        example="behaviors:\n  stop:\n    rules:\n      - when: {reached: true}\n        do: halt",
        mend=(
            "behaviors:\n  stop:\n    rules:\n      - when: {reached: true}\n        do: halt\n"
            "      - otherwise: no action"
        ),
    ),
    _warning(
        code="BB206",
        title="robots that cannot differ",
        explanation=(
            "Several robots start alike, carry the same design, and nothing that they sense or do is drawn or depends "
            "on which robot it is, so that they do the same in every step. One robot would show the same."
        ),
        example="environment:\n  robots: 3\n  state:\n    height: 2\n  dynamics:\n    height: height + speed + 1",
        mend="environment:\n  robots: 3\n  state:\n    height: 2 + robot\n  dynamics:\n    height: height + speed + 1",
    ),
    _warning(
        code="BB207",
        title="a cell that can never be the present one",
        explanation=(
            "From how the values are computed it follows that a cell of an input never applies: its condition "
            "contradicts itself, cells before it always apply first, or the value stays within bounds. Of an input "
            "with one cell left a behavior learns nothing. Where that follows from constants alone nothing is "
            "reported, since a constant may be a switch."
        ),
        example=(
            "behaviors:\n  stop:\n    inputs:\n      place:\n        high: speed > 0\n"
            "        top: speed > 1\n        low: otherwise\n    actions:\n      push: {speed: speed + 1}"
        ),
        mend=(
            "behaviors:\n  stop:\n    inputs:\n      place:\n        top: speed > 1\n"
            "        high: speed > 0\n        low: otherwise\n    actions:\n      push: {speed: speed + 1}"
        ),
    ),
    _warning(
        code="BB208",
        title="a reward term that no behavior can change",
        explanation=(
            "What the term adds up to in an episode does not depend on what any behavior does, neither at once nor "
            "later, nor do behaviors decide when an episode ends. It is the same for all designs, and selects nothing. "
            "A price for each step, such as time: -1, has a meaning where the environment ends episodes early."
        ),
        example="environment:\n  world:\n    wind: 0\n  dynamics:\n    wind: wind + 1\nreward:\n  calm: -abs(wind)",
        mend="reward:\n  calm: -abs(speed)",
    ),
    _warning(
        code="BB209",
        title="a condition that never holds, or always",
        explanation=(
            "Whatever the values compared in it, a behavior would never be excited, an episode would never end, or "
            "would end after its first step. Often and stands for or, or a sign points the wrong way."
        ),
        example="behaviors:\n  stop:\n    excited: height < 2.4 and height > 2.6",
        mend="behaviors:\n  stop:\n    excited: height < 2.4 or height > 2.6",
    ),
    _warning(
        code="BB210",
        title="a rounded number compared by ==",
        explanation=(
            "Fractions are computed with about 16 digits, so that 0.1 + 0.2 is not exactly 0.3: a value that is added "
            "up, drawn or divided hardly ever equals a number exactly. Whole numbers, halves and quarters are exact, "
            "and so is what is set to that number or clipped at it; these are not reported."
        ),
        example="behaviors:\n  stop:\n    inputs:\n      reached: height == 3",
        mend="behaviors:\n  stop:\n    inputs:\n      reached: abs(height - 3) < 0.01",
    ),
    _warning(
        code="BB211",
        title="a robot that is not there",
        explanation=(
            "Robots count from 0, so that the last of three is robot 2. A comparison of robot with any other number "
            "holds for no robot, or for all."
        ),
        example="behaviors:\n  stop:\n    excited: robot == 3",
        mend="behaviors:\n  stop:\n    excited: robot == 2",
    ),
    _warning(
        code="BB212",
        title="a reward term that is always the same",
        explanation=(
            "From how the values are computed it follows that the condition of the term never holds, or always does: a "
            "distance that is kept at 0 or above is never below 0. Where that follows from constants alone nothing is "
            "reported, since a constant may be a switch."
        ),
        example=(
            "environment:\n  dynamics:\n    height: max(height + speed, 0)\n"
            "behaviors:\n  stop:\n    actions:\n      sink: {speed: -1}\nreward:\n  down: -1 if height < 0 else 0"
        ),
        mend=(
            "environment:\n  dynamics:\n    height: max(height + speed, 0)\n"
            "behaviors:\n  stop:\n    actions:\n      sink: {speed: -1}\nreward:\n  down: -1 if height <= 0 else 0"
        ),
    ),
    _warning(
        code="BB215",
        title="a behavior in no layer",
        explanation=(
            "A behavior that the structure does not list is never in control. Where it is left out on purpose, "
            "design.layers says so: how many layers there are."
        ),
        example="behaviors:\n  hurry:\n    actions:\n      go: {speed: 1}\nstructure: [stop]",
        mend="behaviors:\n  hurry:\n    actions:\n      go: {speed: 1}\nstructure: [stop, hurry]",
    ),
)
