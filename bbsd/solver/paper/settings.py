"""The `design` block of a spec as the solver uses it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

from bbsd.solver.paper.genetics import Breeding

if TYPE_CHECKING:
    from bbsd.language.design import Answer, Coevolution, CultureSettings, Learning, MethodName, Stop
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.rates import Rates
    from bbsd.solver.starts import Starts

IN_PYTHON = {"episodes": 2_000, "judged": 1_000}
"""Of the block `answer`, what is the default where the environment is stepped in Python."""


@dataclass(frozen=True, slots=True, eq=False)
class Settings:
    """The parts of a `design` block, their numbers cut to what the spec allows, and what is computed from them."""

    method: MethodName
    """The method that is named, or meant by the keys that are given."""
    budget: int | None
    """Episodes of a run in all; None where they are to be found automatically."""
    sharing: Literal["uniform", "value", "difference"]
    coevolution: Coevolution
    """With at most as many elites as individuals."""
    learning: Learning
    """With the episodes that a lifetime has: the last ones only, where the structure is given."""
    culture: CultureSettings | None
    """None where there is no culture, or no structure that a meme could pass on."""
    answer: Answer
    learned: bool
    """Whether there is a structure to learn."""
    rates: Rates
    """Mutation rates of each generation; learning rate α of (13) and exploration ε of each episode of a lifetime."""
    stop: Stop
    """When a run ends before its budget is spent."""
    starts: Starts | None = None
    """Known designs to begin with."""

    def breeding(self, generation: int) -> Breeding:
        """Return the settings of the genetic operators in a generation, which counts from 1."""
        evolved, rates = self.coevolution, self.rates
        return Breeding(
            tournament=evolved.tournament,
            elites=evolved.elites,
            crossover=float(evolved.crossover),
            children=evolved.children,
            hard_mutation=float(rates.hard_mutation[generation - 1]),
            soft_mutation=float(rates.soft_mutation[generation - 1]),
        )

    def reduced(self, agents: int, episodes: int, **coevolution: int) -> Settings:
        """Return the settings with at most so many agents and episodes of a lifetime, and other numbers as given."""
        agents = min(agents, self.coevolution.agents)
        return replace(
            self,
            coevolution=self.coevolution.model_copy(update={"agents": agents, **coevolution}),
            learning=with_lifetime(self.learning, min(episodes, self.learning.episodes)),
        )


def settings_of(meaning: Meaning, starts: Starts | None = None) -> Settings:
    """Return the settings of a spec, given the meaning whose episodes run (`Problem.meaning`)."""
    design, learned = meaning.spec.design, meaning.structure.is_open
    elites = min(design.coevolution.elites, design.coevolution.population)
    learning = design.learning
    return Settings(
        method=design.chosen_method,
        budget=design.episodes,
        sharing=design.sharing,
        coevolution=design.coevolution.model_copy(update={"elites": elites}),
        learning=with_lifetime(learning, learning.episodes if learned else learning.last),
        culture=design.culture if learned and design.culture != "none" else None,
        answer=_answer_in_python(design.answer) if meaning.episode.outside else design.answer,
        learned=learned,
        rates=meaning.rates,
        stop=design.stop,
        starts=starts,
    )


def _answer_in_python(answer: Answer) -> Answer:
    """Return the settings of the answer where the environment is stepped in Python: fewer episodes unless given."""
    fewer = {key: count for key, count in IN_PYTHON.items() if key not in answer.model_fields_set}
    return answer.model_copy(update=fewer)


def with_lifetime(learning: Learning, episodes: int) -> Learning:
    """Return the settings of a lifetime of so many episodes, of which at most all are the last ones."""
    return learning.model_copy(update={"episodes": episodes, "last": min(learning.last, episodes)})
