"""The worth of a design: of its behaviors, layers and rules, of their order, and what stands out."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture import Architecture, behavior_keys, joint_space
from bbsd.evaluation import Interval, interval, paired_episodes, returns_of
from bbsd.evaluation.situations import situations
from bbsd.evaluation.sums import row_means
from bbsd.explanation.worth.activity import Activity, activities
from bbsd.explanation.worth.earnings import Earnings, earnings
from bbsd.explanation.worth.findings import findings_of
from bbsd.explanation.worth.orders import compare_orders, swapped
from bbsd.explanation.worth.results import BehaviorWorth, RuleWorth, Swap, Worth
from bbsd.explanation.worth.robots import robots_alike
from bbsd.explanation.worth.rules import single_rules
from bbsd.explanation.worth.variants import RANDOM_TABLES, Variants, with_random_tables
from bbsd.kernel.keys import keys as keys_of
from bbsd.kernel.streams import fold, name_word

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.evaluation import PairedEpisodes
    from bbsd.explanation.worth.rules import SingleRule

ORDERS = name_word("worth of orders")
SEEN = 1000
"""Episodes at most in which it is watched who is excited."""


@dataclass(frozen=True)
class Appraisal:
    """A design, and the episodes in which the worth of its parts is measured."""

    problem: Problem
    architecture: Architecture
    key: int
    """Names the stream of the episodes, `evaluation_key` for those of an evaluation."""
    episodes: int
    generation: int

    @cached_property
    def keys(self) -> NDArray[np.uint64]:
        """The keys of the episodes, (n_episodes,)."""
        return keys_of(self.key, 0, self.episodes)

    @cached_property
    def layers(self) -> list[int]:
        """The behaviors of the structure, lowest layer first."""
        return [int(behavior) for behavior in self.architecture.structure]

    @cached_property
    def rules(self) -> dict[int, list[SingleRule]]:
        """The rules of each behavior of the structure."""
        meaning, tables = self.problem.meaning, self.architecture.tables
        return {
            behavior: single_rules(
                meaning.episode.modules[behavior],
                tables[behavior],
                meaning.spec.behaviors[self.problem.names[behavior]].rules or (),
            )
            for behavior in self.layers
        }

    @cached_property
    def _numbered(self) -> tuple[Variants, dict[int, int], dict[tuple[int, int], int], list[int]]:
        """All variants with the numbers of those without a behavior, without a rule, and with two layers exchanged."""
        variants, names = Variants(self.architecture), self.problem.names
        without = {
            behavior: variants.without(behavior, f"without {names[behavior]}") for behavior in self.layers
        }
        without_rule = {
            (behavior, index): variants.with_table(
                behavior, rule.without, f"without a rule of {names[behavior]}"
            )
            for behavior, rules in self.rules.items()
            for index, rule in enumerate(rules)
            if rule.acts or rule.where
        }
        swaps = [
            variants.with_structure(
                swapped(self.architecture.structure, low, low + 1),
                f"with {names[upper]} below {names[lower]}",
            )
            for low, (lower, upper) in enumerate(pairwise(self.layers))
        ]
        return variants, without, without_rule, swaps

    @cached_property
    def paired(self) -> PairedEpisodes:
        """The design and all its variants in the same episodes."""
        variants = self._numbered[0]
        return paired_episodes(
            self.problem,
            variants.agents,
            self.keys,
            self.generation,
            labels=variants.labels,
            all_finite=False,
        )

    def dropped(self, behavior: int) -> Interval:
        """Return the change of the return where a behavior is held to No Action."""
        return self.paired.difference(self._numbered[1][behavior])

    def dropped_rule(self, behavior: int, index: int) -> Interval | None:
        """Return the change of the return without a rule; None where nothing would be dropped."""
        number = self._numbered[2].get((behavior, index))
        return None if number is None else self.paired.difference(number)

    @property
    def random_tables(self) -> int:
        """The number of random tables that replace each behavior's."""
        return min(RANDOM_TABLES, self.episodes)

    def replaced(self, behavior: int) -> Interval:
        """Return the change of the return where a behavior's table is replaced by random ones, the mean over them.

        Each table has its own part of the episodes, so that the tables' means are independent.
        """
        agents = with_random_tables(self.problem, self.architecture, behavior, self.key, self.episodes)
        n_tables = len(agents)
        each = self.episodes // n_tables
        own = self.keys[: n_tables * each].reshape(n_tables, each)
        base = self.paired.returns[0, : n_tables * each].reshape(n_tables, each)
        returns = returns_of(self.problem, agents, own, self.generation, all_finite=False)
        if not np.isfinite(returns).all():
            return interval(returns.ravel())
        return interval(row_means(returns - base))

    @property
    def swaps(self) -> tuple[Swap, ...]:
        """The neighboring layers in exchanged order, from the top of the structure down."""
        space, names = joint_space(self.problem.meaning), self.problem.names
        found = []
        for low, (lower, upper) in enumerate(pairwise(self.layers)):
            exchanged = Architecture(
                self.architecture.tables, swapped(self.architecture.structure, low, low + 1)
            )
            never = None
            if space.is_small:
                one, other = behavior_keys(space, [self.architecture, exchanged])
                never = one == other
            change = self.paired.difference(self._numbered[3][low])
            found.append(Swap(names[upper], names[lower], change, never))
        return tuple(reversed(found))

    @cached_property
    def earned(self) -> Earnings:
        """What each behavior earned in the episodes."""
        agent = Variants(self.architecture).agents
        return earnings(self.problem, agent, self.keys, self.generation)

    @cached_property
    def activity(self) -> dict[int, Activity]:
        """How the robots' time is divided among the behaviors."""
        space = joint_space(self.problem.meaning)
        met = situations(self.problem, space, self.architecture, self.keys[:SEEN], self.generation)
        return activities(space, self.architecture, met)

    def behavior(self, layer: int) -> BehaviorWorth:
        """Return the worth of a layer, counted from 0, and of its behavior."""
        behavior = self.layers[layer]
        activity, control = self.activity[behavior], self._control(behavior)
        return BehaviorWorth(
            behavior=self.problem.names[behavior],
            layer=layer + 1,
            control=control,
            excited=activity.excited,
            activated=activity.activated,
            suppressed=activity.suppressed,
            earned=self.earned_by(behavior),
            dropped=self.dropped(behavior),
            random=self.replaced(behavior),
            expectation=self._expectation(behavior),
            rules=tuple(
                RuleWorth(
                    rule.where,
                    rule.decision,
                    float(activity.by_cell[rule.cells].sum()),
                    self.dropped_rule(behavior, index),
                )
                for index, rule in enumerate(self.rules[behavior])
            ),
        )

    def earned_by(self, behavior: int) -> Mapping[str, float]:
        """Return what was earned while a behavior controlled, per episode, by reward term; -1 is nobody."""
        terms = self.problem.meaning.episode.reward
        return dict(zip(terms, self.earned.by_term[behavior].tolist(), strict=True))

    def _control(self, behavior: int) -> float:
        robots = self.problem.meaning.spec.environment.robots
        return float(self.earned.control[behavior]) / (self.earned.steps * robots)

    def _expectation(self, behavior: int) -> float | None:
        expecting = list(self.problem.meaning.episode.expects)
        name, control = self.problem.names[behavior], float(self.earned.control[behavior])
        if name not in expecting or not control:
            return None
        return float(self.earned.met[expecting.index(name)]) / control

    def worth(self, progress: Callable[[int, int], None] | None = None) -> Worth:
        """Return the worth of all parts of the design; `progress` is called with the parts done and all.

        Raises:
            RewardNotFinite: a reward of the design itself was infinite or not a number.
            TooLongToWatch: an episode has too many steps to record who is excited.
        """
        total = len(self.layers) + 5

        def done(parts: int) -> None:
            if progress is not None:
                progress(parts, total)

        returns = interval(self.paired.returns[0])
        done(1)
        steps = self.earned.steps
        done(2)
        behaviors = []
        for layer in reversed(range(len(self.layers))):
            behaviors.append(self.behavior(layer))
            done(2 + len(behaviors))
        alike = robots_alike(self.problem, self.architecture, self.keys, self.generation)
        done(total - 2)
        choosing = keys_of(fold(self.key, ORDERS), 0, self.episodes)
        orders, precedence = compare_orders(
            self.problem, self.architecture, choosing, self.keys, self.generation
        )
        done(total - 1)
        names = self.problem.names
        worth = Worth(
            name=self.problem.meaning.spec.name,
            returns=returns,
            robots=self.problem.meaning.spec.environment.robots,
            steps=steps,
            behaviors=tuple(behaviors),
            nobody=self.earned_by(-1),
            nobody_control=self._control(-1),
            random_tables=self.random_tables,
            swaps=self.swaps,
            orders=orders,
            precedence=precedence,
            alike=alike,
            findings=findings_of(behaviors, orders, alike, returns, steps),
            left_out=tuple(name for index, name in enumerate(names) if index not in self.layers),
        )
        done(total)
        return worth
