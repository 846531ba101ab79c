"""The kinds of mistakes that only an environment stepped in Python shows, once it was imported: BB113 to BB124."""

from __future__ import annotations

from bbsd.errors.kinds.kind import DiagnosisKind

ENVIRONMENT_KINDS = (
    DiagnosisKind(
        code="BB113",
        title="another number of names than the environment shows numbers",
        explanation=(
            "A list under observation has a name for each number that the environment shows, in its order; _ stands "
            "for a number that is not used. bbsd spaces prints a list that fits."
        ),
        example="environment:\n  gymnasium: CartPole-v1\n  observation: [position, speed, angle]",
        mend="environment:\n  gymnasium: CartPole-v1\n  observation: [position, speed, angle, _]",
    ),
    DiagnosisKind(
        code="BB114",
        title="a path that leads to no number of an observation",
        explanation=(
            "A path goes from the whole observation to one number: keys of mappings, places in tuples, and an index "
            "for each dimension of an array, all from 0."
        ),
        example='environment:\n  gymnasium: CartPole-v1\n  observation: {angle: "[4]"}',
        mend='environment:\n  gymnasium: CartPole-v1\n  observation: {angle: "[2]"}',
    ),
    DiagnosisKind(
        code="BB115",
        title="sizes that do not fit the environment",
        explanation=(
            "A single whole number can be taken apart into fields with sizes, the first the most significant, as "
            "100 row + 20 column + ... is; the product of their sizes is how many values the number has. Where the "
            "environment shows several whole numbers, each has its own size. Other numbers have none."
        ),
        example="environment:\n  gymnasium: FrozenLake-v1\n  observation: {row: 4, column: 5}\n  action: push",
        mend="environment:\n  gymnasium: FrozenLake-v1\n  observation: {row: 4, column: 4}\n  action: push",
    ),
    DiagnosisKind(
        code="BB116",
        title="an observation that is not all numbers",
        explanation=(
            "A list names every number of an observation, which is not possible where parts of it are texts or graphs; "
            "paths name the numbers that are wanted."
        ),
        example="environment:\n  gymnasium: minigrid:MiniGrid-Empty-5x5-v0\n  observation: [direction]",
        mend="environment:\n  gymnasium: minigrid:MiniGrid-Empty-5x5-v0\n  observation: {facing: direction}",
    ),
    DiagnosisKind(
        code="BB117",
        title="another number of actions than the environment takes",
        explanation=(
            "action names the state whose value is sent at each step: one name where the environment takes one number, "
            "a list of names, in its order, where it takes several."
        ),
        example="environment:\n  gymnasium: CartPole-v1\n  action: [push, again]\n  state: {again: 0}",
        mend="environment:\n  gymnasium: CartPole-v1\n  action: push",
    ),
    DiagnosisKind(
        code="BB118",
        title="a value that the environment does not take",
        explanation=(
            "What is sent is never rounded and never cut off: it must be one of the values that the environment takes, "
            "a whole number where it takes whole numbers. That holds for the value at the start too, which is sent "
            "as long as no behavior controls."
        ),
        example="environment:\n  gymnasium: CartPole-v1\n  state: {push: 2}",
        mend="environment:\n  gymnasium: CartPole-v1\n  state: {push: 1}",
    ),
    DiagnosisKind(
        code="BB119",
        title="an environment that does not take numbers",
        explanation=(
            "A number, an array of numbers, or several single numbers can be sent; mappings, texts and graphs cannot. "
            "A class of one's own around the environment can make what it takes of numbers."
        ),
        example="environment:\n  python: my_module:TakesMappings",
        mend="environment:\n  python: my_module:TakesNumbers",
    ),
    DiagnosisKind(
        code="BB120",
        title="another number of robots than the environment has",
        explanation=(
            "The agents of a PettingZoo environment are the robots, so robots is their number; other environments "
            "have one robot."
        ),
        example="environment:\n  pettingzoo: mpe2.simple_spread_v3\n  robots: 2",
        mend="environment:\n  pettingzoo: mpe2.simple_spread_v3\n  robots: 3",
    ),
    DiagnosisKind(
        code="BB121",
        title="an environment that is not there",
        explanation=(
            "The module was imported, and has no such environment. Versions that were replaced are often gone: the "
            "number at the end of a name goes up when an environment changes. An environment that another package "
            "registers is written with its module before it."
        ),
        example="environment:\n  gymnasium: CartPole-v7",
        mend="environment:\n  gymnasium: CartPole-v1",
    ),
    DiagnosisKind(
        code="BB122",
        title="arguments with which an environment cannot be made",
        explanation="What stands under with is given to the environment when it is made, and it refused that.",
        example="environment:\n  gymnasium: CartPole-v1\n  with: {wheels: 4}",
        mend="environment:\n  gymnasium: CartPole-v1\n  with: {sutton_barto_reward: true}",
    ),
    DiagnosisKind(
        code="BB123",
        title="a configuration file that is not understood",
        explanation=(
            "The file config.yaml in the folder bbsd of the system's folder for configuration may list modules that "
            "every spec may import. Since it allows code to run, only its owner may write it, and it has no other key."
        ),
        example="allow_import: gymnasium",
        mend="allow_import: [gymnasium]",
    ),
    DiagnosisKind(
        code="BB124",
        title="agents that observe or do different things",
        explanation=(
            "All robots carry the same design, so all agents must observe the same numbers and take the same actions. "
            "Wrappers of PettingZoo and SuperSuit can pad them to the same size, in a class of one's own."
        ),
        example="environment:\n  pettingzoo: mpe2.simple_adversary_v3\n  robots: 3",
        mend="environment:\n  pettingzoo: mpe2.simple_spread_v3\n  robots: 3",
    ),
)
