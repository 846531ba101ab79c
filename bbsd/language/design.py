"""The `design` block: how the holes are filled. The defaults are the paper's Table 1 for object lifting."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator, Discriminator, Field, Tag

from bbsd.language.base import Part
from bbsd.language.field_types import (
    Expression,
    ExpressionText,
    Whole,
    expression,
    grouped,
    shape,
    word_list_or_number,
    word_or_number,
)

MethodName = Literal[
    "auto", "paper", "societies", "practice", "cross_entropy", "random", "hill", "joint", "q"
]
LOOP = ("coevolution", "learning", "culture", "sharing")
"""The keys of the paper's loop: a spec that has any of them and names no method is designed by it."""
LEAST_BUDGET = 5_000
"""Episodes; with fewer, the final race cannot let two designs run 400 episodes each."""

HARD_MUTATION = "0.01 / log2(generation + 1) if generation <= 0.8 * generations else 0"
SOFT_MUTATION = "2 * hard_mutation"


def _default(text: str) -> Expression:
    return expression(text)


class Coevolution(Part):
    """Cooperative co-evolution of the behaviors (V.B)."""

    generations: Whole = Field(50, ge=1, le=100_000, description="Generations of a run.")
    population: Whole = Field(20, ge=1, le=100_000, description="Individuals in each behavior's pool.")
    agents: Whole = Field(200, ge=1, le=1_000_000, description="Agents put together in each generation.")
    pairing: Literal["balanced", "random", "proportional"] = Field(
        "balanced",
        description="Which individuals meet: all equally often, at random, or by fitness, "
        "where a child's is its parents' mean.",
    )
    tournament: Whole = Field(3, ge=1, le=1000, description="Individuals that compete to be a parent.")
    elites: Whole = Field(1, ge=0, description="Best individuals copied unchanged into the next generation.")
    crossover: float = Field(
        0.5, ge=0, le=1, description="Probability p_c that a cell comes from the first parent (19)."
    )
    children: Literal[1, 2] = Field(
        1,
        description="Children of a pair of parents: by the mask X of (19), and a second one by its complement.",
    )
    hard_mutation: ExpressionText = Field(
        _default(HARD_MUTATION),
        description="Probability that a child's table is replaced by a random one; "
        "may use generation, generations.",
    )
    soft_mutation: ExpressionText = Field(
        _default(SOFT_MUTATION),
        description="Probability that a cell is drawn anew; may use generation, generations, hard_mutation.",
    )


class Learning(Part):
    """Learning of the structure during a lifetime (V.A)."""

    episodes: Whole = Field(
        25, ge=1, le=100_000, description="Episodes of a lifetime in which a structure is learned."
    )
    last: Whole = Field(
        5,
        ge=1,
        le=1_000_000,
        description="K of (14): fitness is the mean return of so many last episodes; "
        "of the whole lifetime where the structure is given.",
    )
    rate: ExpressionText = Field(
        _default("0.1 * 0.99 ** episode"), description="Learning rate of (13); may use episode, episodes."
    )
    estimate: Literal["joint", "counters"] = Field(
        "joint",
        description="What is learned of a behavior in a layer: Ṽ by (13), or V by (11) and counted probabilities.",
    )
    outside: Literal["keep", "decay"] = Field(
        "keep",
        description="What happens to Ṽ of a pair of layer and behavior that is not in the present structure: "
        "it stays, or it moves toward 0 as (13) says literally.",
    )
    exploration: ExpressionText = Field(
        _default("0"),
        description="Probability of a random structure in an episode, never in the last ones; "
        "may use episode, episodes.",
    )
    explored: Literal["kept", "dropped"] = Field(
        "kept",
        description="Whether a random structure that was explored is the one that the next ones compete with, "
        "or that of before.",
    )
    search: Literal["sampled", "exact"] = Field(
        "sampled",
        description="How a structure is chosen before an episode: among random ones, or exactly.",
    )
    candidates: Whole = Field(
        20, ge=1, le=100_000, description="Random structures that compete with the present one."
    )


class CultureSettings(Part):
    """The culture of memes (V.C)."""

    size: Whole = Field(5, ge=1, le=10_000, description="Memes that the culture holds.")
    rate: float = Field(0.3, ge=0, le=1, description="Forgetting factor of a meme's fitness (22).")
    scaled: float = Field(
        0.9,
        ge=0,
        le=1,
        description="Probability that a meme is drawn by scaled roulette instead of at random.",
    )


class Answer(Part):
    """The final race between candidates."""

    candidates: Whole = Field(1000, ge=1, le=100_000, description="Champions that enter the final race.")
    episodes: Whole = Field(
        20_000, ge=100, le=10_000_000, description="Fresh episodes at most for each of them."
    )
    judged: Whole = Field(
        5_000, ge=100, le=10_000_000, description="Further episodes on which the winner is judged."
    )


class Stop(Part):
    """When a run ends before its budget is spent, looked at whenever the best so far is measured."""

    return_: float | None = Field(
        None,
        alias="return",
        description="The return that is enough: the 95 % interval of the best so far lies above it, in episodes that "
        "had no part in choosing it.",
    )
    unimproved: Annotated[Whole | None, Field(ge=1_000), BeforeValidator(grouped)] = Field(
        None, description="Episodes after which the search ends where nothing better was found in them."
    )


class Design(Part):
    """How the holes of a spec are filled."""

    method: MethodName = Field(
        "auto",
        description="How designs are searched for; without it, `paper` where any of coevolution, learning, culture "
        "and sharing is given.",
    )
    budget: Annotated[
        Annotated[Whole, Field(ge=LEAST_BUDGET, le=1_000_000_000_000), Tag("<number>")]
        | Annotated[Literal["auto"], Tag("<word>")],
        Discriminator(word_or_number),
        BeforeValidator(grouped),
    ] = Field(
        "auto",
        description="Episodes of a run in all, the final race included, at least 5,000; with `paper`, those of its "
        "generations.",
    )
    stop: Stop = Field(Stop(), description="When a run ends before its budget is spent.")
    layers: Whole | None = Field(
        None,
        ge=1,
        le=64,
        description="Open layers where no structure is given; by default one for each behavior.",
    )
    sharing: Literal["uniform", "value", "difference"] = Field(
        "uniform",
        description="How agents' fitness is shared: (15), (17), or by what an agent earns less with the behavior "
        "held to No Action.",
    )
    coevolution: Coevolution = Field(Coevolution(), description="Cooperative co-evolution of the behaviors.")
    learning: Learning = Field(Learning(), description="Learning of the structure.")
    culture: Annotated[
        Annotated[CultureSettings, Tag("<mapping>")] | Annotated[Literal["none"], Tag("<other>")],
        Discriminator(shape),
    ] = Field(CultureSettings(), description="The culture of memes, or none.")
    answer: Answer = Field(Answer(), description="The choice of the final answer.")
    record: Annotated[
        Annotated[Whole, Field(ge=1), Tag("<number>")]
        | Annotated[list[Annotated[Whole, Field(ge=1)]], Tag("<list>")]
        | Annotated[Literal["none"], Tag("<word>")],
        Discriminator(word_list_or_number),
    ] = Field(
        "none",
        description="Generations whose agents are written down, every so many or a list of them, beside the culture of "
        "all; with methods other than `paper`, records of `metrics.jsonl` at which the champions are.",
    )

    @property
    def loop_keys(self) -> tuple[str, ...]:
        """The keys of the paper's loop that are given."""
        return tuple(key for key in LOOP if key in self.model_fields_set)

    @property
    def chosen_method(self) -> MethodName:
        """The method that is named, or else meant by the keys that are given."""
        if "method" in self.model_fields_set:
            return self.method
        return "paper" if self.loop_keys else "auto"

    def records(self, number: int) -> bool:
        """Return whether agents of a generation, or champions at a record, are written down; numbers count from 1."""
        if self.record == "none":
            return False
        return number in self.record if isinstance(self.record, list) else number % self.record == 0

    @property
    def episodes(self) -> int | None:
        """The budget of a run as a number, or None where it is automatic."""
        return None if self.budget == "auto" else self.budget
