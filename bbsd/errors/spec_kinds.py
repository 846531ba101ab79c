"""The kinds of mistakes in a spec's form and meaning; the first were BB020 to BB049.

An example is a part of a spec, or an argument of the command line where it begins with `--set`.
"""

from __future__ import annotations

from bbsd.errors.kind import DiagnosisKind

SPEC_KINDS = (
    DiagnosisKind(
        code="BB020",
        title="an unexpected key",
        explanation=(
            "Each block of a spec has its own keys, and whatever is not one of them would have no effect, "
            "so it is refused. Keys of your own begin with x- and are ignored."
        ),
        example="environment:\n  step: 300",
        mend="environment:\n  steps: 300",
    ),
    DiagnosisKind(
        code="BB021",
        title="a missing key",
        explanation="Some keys have no default: without them there is nothing to design.",
        example="behaviors:\n  hurry_up:\n    excited: tilted",
        mend=(
            "behaviors:\n"
            "  hurry_up:\n"
            "    excited: tilted\n"
            "    actions:\n"
            "      faster:\n"
            "        speed: speed + 1"
        ),
    ),
    DiagnosisKind(
        code="BB022",
        title="the wrong kind of value",
        explanation=(
            "What stands here is a number where a text is needed, a list where a mapping is, or the like. "
            "Quotes make a text of a number; three is a text and 3 a number."
        ),
        example="environment:\n  robots: three",
        mend="environment:\n  robots: 3",
    ),
    DiagnosisKind(
        code="BB023",
        title="a value that is not allowed",
        explanation=(
            "The value is of the right kind, but outside of its bounds or none of the words that can "
            "stand here."
        ),
        example="environment:\n  robots: 300",
        mend="environment:\n  robots: 30",
    ),
    DiagnosisKind(
        code="BB024",
        title="not a name",
        explanation=(
            "Names are small letters, digits and _, beginning with a letter, and not a word that means something "
            "else where they stand: what expressions use cannot be called step or team, a behavior not open. A "
            "definition's key is a name, or a name with its parameters: name(a, b)."
        ),
        example="constants:\n  TopSpeed: 5",
        mend="constants:\n  top_speed: 5",
    ),
    DiagnosisKind(
        code="BB025",
        title="a name for two things",
        explanation=(
            "Constants, world, state, definitions, sensors and observations share their names, since an expression "
            "could not tell them apart."
        ),
        example="constants:\n  speed: 5",
        mend="constants:\n  top_speed: 5",
    ),
    DiagnosisKind(
        code="BB026",
        title="another version of the language",
        explanation=(
            "The key bbsd gives the version of the language that a spec is written in. This program reads "
            "version 1."
        ),
        example="bbsd: 2",
        mend="bbsd: 1",
    ),
    DiagnosisKind(
        code="BB027",
        title="an empty block",
        explanation=(
            "There must be at least one behavior, one term of the reward, and one cell where a rule names "
            "an input."
        ),
        example="reward: {}",
        mend="reward:\n  near: 1 if abs(height - 3) < 0.5 else 0",
    ),
    DiagnosisKind(
        code="BB028",
        title="an override that cannot be set",
        explanation=(
            "--set takes PATH=VALUE. The path leads from key to key by dots and into lists by [0], [1], "
            "..., to what the spec has or the language has a default for; the value is read as YAML, and "
            "null takes the key away."
        ),
        example="--set design.coevolution.generatoins=10",
        mend="--set design.coevolution.generations=10",
    ),
    DiagnosisKind(
        code="BB029",
        title="a file that cannot be extended",
        explanation=(
            "extends names a file in the spec's own folder or below it, links followed, so that a spec from "
            "elsewhere cannot reach other files. Files cannot extend each other in a circle, and at most ten, "
            "of 1 MB together, are read."
        ),
        example="extends: ../lifting.yaml",
        mend="extends: bases/lifting.yaml",
    ),
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
        code="BB033",
        title="something that cannot be set",
        explanation=(
            "An action sets its own robot's state; dynamics give the next values of world and state. "
            "Constants, sensors and definitions follow from other values and are never set."
        ),
        example="behaviors:\n  stop:\n    actions:\n      halt:\n        tilt: 0",
        mend="behaviors:\n  stop:\n    actions:\n      halt:\n        speed: 0",
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
        code="BB043",
        title="a rate that is no probability",
        explanation=(
            "Mutation is a probability in every generation, and the learning rate a weight in every "
            "episode; each must stay from 0 to 1."
        ),
        example="design:\n  learning:\n    rate: 2 / episode",
        mend="design:\n  learning:\n    rate: 1 / episode",
    ),
    DiagnosisKind(
        code="BB045",
        title="a reward that is not finite",
        explanation=(
            "A term of the reward became infinite or no number while episodes ran, by a division by zero "
            "or the like. Division, overflow and roots of negative numbers are no errors in themselves, "
            "but nothing can be learned from what they leave in the reward."
        ),
        example="reward:\n  near: 1 / (height - height)",
        mend="reward:\n  near: 1 / max(height, 0.01)",
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
        code="BB048",
        title="a design that could not be written",
        explanation=(
            "What bbsd design writes is a spec again, within a spec's bounds: 1 MB, and 50 000 keys and values. "
            "A design that would not fit is refused before it is begun. A cell takes a character, so there is "
            "room for tables of about 900 000 cells together."
        ),
        example="behaviors:\n  stop:\n    inputs:\n      at: values(round(height * 100000), 0, 999999)",
        mend="behaviors:\n  stop:\n    inputs:\n      at: values(round(height * 100), 0, 999)",
    ),
    DiagnosisKind(
        code="BB049",
        title="a view that cannot be drawn",
        explanation=(
            "A place is [x, y] or [x, y, radius], the area around has two corners [x, y, x, y] that lie apart, "
            "circles are rows of [x, y, radius], and a grid is a table whose rows are equally long."
        ),
        example="view:\n  at: height",
        mend="view:\n  at: [robot, height]",
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
    DiagnosisKind(
        code="BB140",
        title="a block at the wrong depth",
        explanation=(
            "What belongs to a block is indented below its key, and what stands beside it begins in the column of that "
            "key. An empty block with its entries beside it, or a block in its neighbor, is probably a matter of a "
            "few blanks; all else is then read as it is meant."
        ),
        example="behaviors:\n  stop:\n    actions:\n      rules:\n        - otherwise: halt",
        mend="behaviors:\n  stop:\n    rules:\n      - otherwise: halt",
    ),
)
