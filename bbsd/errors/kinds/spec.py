"""The kinds of mistakes in a spec's form and meaning, but for behaviors; the first were BB020 to BB049.

An example is a part of a spec, or an argument of the command line where it begins with `--set`.
"""

from __future__ import annotations

from bbsd.errors.kinds.kind import DiagnosisKind

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
