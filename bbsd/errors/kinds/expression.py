"""The kinds of mistakes in expressions; the first were BB050 to BB068. An example is a part of a spec."""

from __future__ import annotations

from bbsd.errors.kinds.kind import DiagnosisKind

EXPRESSION_KINDS = (
    DiagnosisKind(
        code="BB050",
        title="not an expression",
        explanation=(
            "Expressions are written as in Python: arithmetic, comparisons, and, or, not, x if condition "
            "else y, and calls of listed functions. This text cannot be read as one."
        ),
        example="environment:\n  sensors:\n    tilted: tilt > (1",
        mend="environment:\n  sensors:\n    tilted: tilt > 1",
    ),
    DiagnosisKind(
        code="BB051",
        title="not in the language",
        explanation=(
            "Python would read this, but the language is a small part of Python: no attributes, texts, "
            "lists in brackets, comprehensions, lambdas or assignments."
        ),
        example="environment:\n  sensors:\n    tilted: robot.tilt > 1",
        mend="environment:\n  sensors:\n    tilted: tilt > 1",
    ),
    DiagnosisKind(
        code="BB052",
        title="an unknown name",
        explanation=(
            "Expressions may use constants, world, state, definitions and sensors, as far as they are "
            "given in the spec."
        ),
        example="environment:\n  sensors:\n    tilted: tild > 1",
        mend="environment:\n  sensors:\n    tilted: tilt > 1",
    ),
    DiagnosisKind(
        code="BB053",
        title="an unknown function",
        explanation=(
            "Only the listed functions, aggregates and draws can be called, and definitions that have "
            "parameters."
        ),
        example="environment:\n  sensors:\n    tilted: absolute(tilt) > 1",
        mend="environment:\n  sensors:\n    tilted: abs(tilt) > 1",
    ),
    DiagnosisKind(
        code="BB054",
        title="too many arguments or too few",
        explanation="Each function and each definition takes its own number of arguments.",
        example="environment:\n  sensors:\n    tilted: hypot(tilt) > 1",
        mend="environment:\n  sensors:\n    tilted: hypot(tilt, speed) > 1",
    ),
    DiagnosisKind(
        code="BB055",
        title="a truth for a number, or a number for a truth",
        explanation=(
            "Truths and numbers never stand for each other, so that a comparison that was forgotten is "
            "noticed. 1 if c else 0 makes a number of a truth, a comparison a truth of a number."
        ),
        example="reward:\n  near: abs(height - 3) < 1",
        mend="reward:\n  near: 1 if abs(height - 3) < 1 else 0",
    ),
    DiagnosisKind(
        code="BB056",
        title="a list for one value, or one value for a list",
        explanation=(
            "Arithmetic, comparisons and what a spec sets are of single values. min, max, sum, mean, any "
            "and all make one of several; [k] takes one of a list."
        ),
        example="environment:\n  sensors:\n    tilted: list(tilt, speed) > 1",
        mend="environment:\n  sensors:\n    tilted: max(tilt, speed) > 1",
    ),
    DiagnosisKind(
        code="BB057",
        title="an index that does not fit",
        explanation=(
            "Lists, tables and what each robot has are indexed by [k], counted from 0. An index that is "
            "computed is clamped to the range, one that is written must lie in it."
        ),
        example="environment:\n  sensors:\n    tilted: height[3] > 1      # of three robots",
        mend="environment:\n  sensors:\n    tilted: height[2] > 1",
    ),
    DiagnosisKind(
        code="BB058",
        title="a draw where none is allowed",
        explanation=(
            "Values can be drawn in constants, starts, actions, dynamics and sensors. Elsewhere, as in "
            "the reward, in conditions and in definitions, each use would draw anew; draw it once as "
            "state or a sensor."
        ),
        example="reward:\n  near: uniform(0, 1)",
        mend="environment:\n  sensors:\n    luck: uniform(0, 1)\nreward:\n  near: luck",
    ),
    DiagnosisKind(
        code="BB059",
        title="one robot's value, where the team is meant",
        explanation=(
            "State and sensors have a value for each robot. What there is once, such as world and the end "
            "of an episode, needs an aggregate of them or one robot's."
        ),
        example="environment:\n  ends: height > 3",
        mend="environment:\n  ends: all(height[r] > 3 for r in team)",
    ),
    DiagnosisKind(
        code="BB060",
        title="too long or too deep",
        explanation=(
            "An expression may have 4000 characters and be nested 40 deep, a list 10 000 elements, and a "
            "value may need only so many others one after the other. Definitions and shorter lists help."
        ),
        example="reward:\n  near: sum(height for k in range(20000))",
        mend="reward:\n  near: sum(height for k in range(20))",
    ),
    DiagnosisKind(
        code="BB061",
        title="a power of one changing number by another",
        explanation=(
            "In x ** y one of the two must be the same for the whole run, so that it is clear what a "
            "negative x means."
        ),
        example="reward:\n  near: height ** speed",
        mend="reward:\n  near: height ** 2",
    ),
    DiagnosisKind(
        code="BB062",
        title="a generator that does not fit",
        explanation=(
            "e for v in S is the only argument of an aggregate. S is team, others, range(n), a list, or a "
            "table, whose rows can be taken apart: for x, y in S."
        ),
        example="reward:\n  near: sum(height[r] for r in team if r > 0)",
        mend="reward:\n  near: sum(height[r] if r > 0 else 0 for r in team)",
    ),
    DiagnosisKind(
        code="BB063",
        title="values that need each other",
        explanation=(
            "Constants, starting values, definitions and sensors are computed one after the other, so "
            "none can need itself. What it was a step before is state."
        ),
        example="environment:\n  sensors:\n    tilt: turn + 1\n    turn: tilt - 1",
        mend="environment:\n  sensors:\n    tilt: speed + 1\n    turn: tilt - 1",
    ),
    DiagnosisKind(
        code="BB064",
        title="not a whole number",
        explanation=(
            "An index, what values(...) divides, and the length of a range are whole numbers, and that "
            "must follow from how they are computed. floor(...) and round(...) make them so."
        ),
        example="behaviors:\n  stop:\n    inputs:\n      reached: values(height, 0, 5)",
        mend="behaviors:\n  stop:\n    inputs:\n      reached: values(floor(height), 0, 5)",
    ),
    DiagnosisKind(
        code="BB065",
        title="before(...) where it has no meaning",
        explanation=(
            "before(e) is e as it was when the behaviors decided. It has a meaning in dynamics, sensors, "
            "the reward, ends, and what a behavior expects, not where the decision is made."
        ),
        example="behaviors:\n  stop:\n    excited: height > before(height)",
        mend=(
            "environment:\n"
            "  sensors:\n"
            "    rises: height > before(height)\n"
            "behaviors:\n"
            "  stop:\n"
            "    excited: rises"
        ),
    ),
    DiagnosisKind(
        code="BB066",
        title="not known here",
        explanation=(
            "Sensors are not known when the starting values are made, the generation only in constants "
            "and mutation rates, the episode only in the learning rate. A behavior knows its own robot's "
            "state and sensors; of the world and of other robots it knows what a sensor tells it."
        ),
        example="reward:\n  near: generation",
        mend="constants:\n  bonus: generation\nreward:\n  near: bonus",
    ),
    DiagnosisKind(
        code="BB067",
        title="a partition used as a value",
        explanation=(
            "cut(...), values(...) and named cells say how a behavior's input is divided; in an "
            "expression use what they divide."
        ),
        example=(
            "environment:\n  sensors:\n    zone: cut(height, 2, 3)\nreward:\n  near: 1 if zone > 1 else 0"
        ),
        mend="environment:\n  sensors:\n    zone: cut(height, 2, 3)\nreward:\n  near: 1 if height > 2 else 0",
    ),
    DiagnosisKind(
        code="BB068",
        title="too many values",
        explanation=(
            "Robots, lists and generators are written out when a spec is read, and the values that a step "
            "then computes are limited to 100 000, so that no small spec can exhaust the machine; so are the steps "
            "of computing a rate for all generations or episodes, to 600 000."
        ),
        example="reward:\n  near: sum(sum(height * i + j for i in range(5000)) for j in range(5000))",
        mend="reward:\n  near: sum(sum(height * i + j for i in range(50)) for j in range(50))",
    ),
    DiagnosisKind(
        code="BB125",
        title="a number that is not what it looks like",
        explanation=(
            "Numbers are binary64, and what is written is what is kept. A zero in front makes a number octal in other "
            "languages; a whole number beyond 2 ** 53 may lose its last digits; and what comes to infinity or to no "
            "number at all, whatever happens in an episode, is no value."
        ),
        example="constants:\n  limit: 010\nreward:\n  near: limit",
        mend="constants:\n  limit: 10\nreward:\n  near: limit",
    ),
    DiagnosisKind(
        code="BB141",
        title="a draw with impossible numbers",
        explanation=(
            "A probability is a number from 0 to 1, no percentage; a standard deviation is not negative; uniform and "
            "integers draw from the smaller of their two numbers up to the larger one."
        ),
        example="environment:\n  dynamics:\n    speed: 1 if chance(20) else 0",
        mend="environment:\n  dynamics:\n    speed: 1 if chance(0.2) else 0",
    ),
)
