"""The kinds of mistakes in behaviors and their structure: inputs and cells, rules and tables, actions, layers."""

from __future__ import annotations

from bbsd.errors.kinds.kind import DiagnosisKind

BEHAVIOR_KINDS = (
    DiagnosisKind(
        code="BB030",
        title="an input that is not partitioned",
        explanation=(
            "A behavior's table has a row for each cell of its inputs (Table 2), so an input must have "
            "finitely many: a condition has two, cut(...) and values(...) make as many as you need."
        ),
        example="behaviors:\n  stop:\n    inputs:\n      reached: height",
        mend="behaviors:\n  stop:\n    inputs:\n      reached: cut(height, 2, 3)",
    ),
    DiagnosisKind(
        code="BB031",
        title="cut(...) or values(...) with arguments that do not fit",
        explanation=(
            "cut(e, c1, c2, ...) takes a number and growing bounds. values(e, first, last) takes a whole "
            "number and the first and last of at least two whole numbers."
        ),
        example="behaviors:\n  stop:\n    inputs:\n      reached: cut(height, 3, 2)",
        mend="behaviors:\n  stop:\n    inputs:\n      reached: cut(height, 2, 3)",
    ),
    DiagnosisKind(
        code="BB032",
        title="cells that may leave a gap",
        explanation=(
            "There must be two cells or more, and one of the conditions must hold in every state. Where "
            "that does not follow from the comparisons alone, the last cell is written with the condition "
            "otherwise."
        ),
        example="environment:\n  sensors:\n    zone:\n      low: height < 2\n      high: height > 2",
        mend="environment:\n  sensors:\n    zone:\n      low: height < 2\n      high: otherwise",
    ),
    DiagnosisKind(
        code="BB034",
        title="a rule with an unknown input",
        explanation="A rule can ask only for the inputs of its own behavior.",
        example="behaviors:\n  stop:\n    rules:\n      - when: {tilted: true}\n        do: halt",
        mend="behaviors:\n  stop:\n    rules:\n      - when: {reached: true}\n        do: halt",
    ),
    DiagnosisKind(
        code="BB035",
        title="a rule with an unknown cell",
        explanation=(
            "A rule names the cells of an input as its partition labels them: true and false for a "
            "condition, below 2, 2 to 3, from 3 for cut(e, 2, 3), and ranges of these; the numbers of "
            "values(...); the names of named cells."
        ),
        example="behaviors:\n  stop:\n    rules:\n      - when: {reached: yes}\n        do: halt",
        mend="behaviors:\n  stop:\n    rules:\n      - when: {reached: true}\n        do: halt",
    ),
    DiagnosisKind(
        code="BB036",
        title="a rule with an unknown action",
        explanation=(
            "What a rule does is one of its own behavior's actions, no action, or open, which leaves it "
            "to the design."
        ),
        example="behaviors:\n  stop:\n    rules:\n      - otherwise: Halt",
        mend="behaviors:\n  stop:\n    rules:\n      - otherwise: halt",
    ),
    DiagnosisKind(
        code="BB037",
        title="a rule that never applies",
        explanation=(
            "The first rule that matches decides, and the ones before this match every cell that it does."
        ),
        example=(
            "behaviors:\n"
            "  stop:\n"
            "    rules:\n"
            "      - otherwise: halt\n"
            "      - when: {reached: false}\n"
            "        do: no action"
        ),
        mend=(
            "behaviors:\n"
            "  stop:\n"
            "    rules:\n"
            "      - when: {reached: false}\n"
            "        do: no action\n"
            "      - otherwise: halt"
        ),
    ),
    DiagnosisKind(
        code="BB038",
        title="no actions, or too many",
        explanation="A behavior has 1 to 200 actions; No Action is there without being listed.",
        example="behaviors:\n  stop:\n    actions: {}",
        mend="behaviors:\n  stop:\n    actions:\n      halt:\n        speed: 0",
    ),
    DiagnosisKind(
        code="BB039",
        title="too large a table",
        explanation=(
            "A behavior's table has as many cells as its inputs have together, multiplied. More than a "
            "million could neither be searched nor read."
        ),
        example=(
            "behaviors:\n"
            "  stop:\n"
            "    inputs:\n"
            "      fine: values(speed, 0, 1999)\n"
            "      coarse: values(speed, 0, 999)"
        ),
        mend=(
            "behaviors:\n"
            "  stop:\n"
            "    inputs:\n"
            "      fine: values(speed, 0, 19)\n"
            "      coarse: values(speed, 0, 9)"
        ),
    ),
    DiagnosisKind(
        code="BB040",
        title="an input listed twice",
        explanation=(
            "Each input is one dimension of the behavior's table, so a second time it adds nothing but "
            "impossible cells."
        ),
        example="behaviors:\n  stop:\n    inputs: [tilted, tilted]",
        mend="behaviors:\n  stop:\n    inputs: [tilted]",
    ),
    DiagnosisKind(
        code="BB041",
        title="an input that is no sensor",
        explanation=(
            "A list of inputs names sensors that are partitions, and truths of the robot's own state. What "
            "only one behavior looks at can be partitioned there: inputs is then a mapping from a name to "
            "what it cuts."
        ),
        example="environment:\n  definitions:\n    high: height > 3\nbehaviors:\n  stop:\n    inputs: [high]",
        mend="environment:\n  sensors:\n    high: height > 3\nbehaviors:\n  stop:\n    inputs: [high]",
    ),
    DiagnosisKind(
        code="BB042",
        title="an impossible structure",
        explanation=(
            "A structure lists behaviors from the highest layer down, each at most once, or open for a "
            "layer that a behavior not listed will take."
        ),
        example="structure: [stop, stop]",
        mend="structure: [stop]",
    ),
    DiagnosisKind(
        code="BB046",
        title="a table that does not fit",
        explanation=(
            "A table has a character for each combination of its inputs' cells, the last input changing "
            "fastest: . or 0 for no action, 1 to 9, a to z, A to Z and then accented letters for the "
            "behavior's actions in their order, ? for open. White space only divides it."
        ),
        example='behaviors:\n  stop:\n    table: "1.1"      # reached is false or true',
        mend='behaviors:\n  stop:\n    table: ".1"',
    ),
    DiagnosisKind(
        code="BB047",
        title="both rules and a table",
        explanation="A behavior's cells are given by rules or by a table, so one of the two must go.",
        example='behaviors:\n  stop:\n    rules:\n      - otherwise: halt\n    table: ".1"',
        mend="behaviors:\n  stop:\n    rules:\n      - otherwise: halt",
    ),
    DiagnosisKind(
        code="BB127",
        title="a shape that differs from robot to robot",
        explanation=(
            "All robots carry one architecture: each behavior has one table for all of them, so that the cells of an "
            "input must be the same for every robot, and so must be the length of a list that a sensor or a state is."
        ),
        example="environment:\n  sensors:\n    place: values(round(height), 0, robot + 1)",
        mend="environment:\n  sensors:\n    place: values(round(height), 0, 3)",
    ),
)
