"""A design as an agent in a program of one's own: it is given what it perceives, and says what it does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from bbsd.agent.inputs import AgentInput, BadInput
from bbsd.agent.making import Design, design_of, program_of
from bbsd.agent.program import Act, SetValue, plain_functions
from bbsd.api.given.arguments import MOST_SEED, Assignments, checked, instance, optional, whole
from bbsd.api.specs import AnySpec, loaded_from
from bbsd.architecture import architecture_of
from bbsd.architecture.needs import plain_name
from bbsd.expression.nesting import by_name
from bbsd.kernel.streams import fold, name_word
from bbsd.language.meaning import seed_key

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    import numpy.typing as npt

    from bbsd.agent.many import Acts, Many
    from bbsd.agent.program import Kept
    from bbsd.explanation.why import Answer

NotFinite = Literal["refuse", "count"]


class NothingDone(ValueError):
    """An agent that is asked why before it did anything."""


class Agent:
    """One robot with a design.

    `act` is called once a step, with a value for each of `inputs`. What the robot can know by itself, the agent keeps:
    its `memory`, state that actions set and that changes by what the robot knows, and what sensors say of before.
    Sensors that draw, look at the world or at other robots are given; all others are computed.
    """

    @checked()
    def __init__(
        self,
        spec: AnySpec,
        *,
        robot: int = 0,
        measured: Collection[str] = (),
        remembered: Collection[str] = (),
        not_finite: NotFinite = "refuse",
        seed: int = 0,
        set: Assignments = (),
    ) -> None:
        """Make the agent of a design.

        Args:
            spec: A design: a spec without holes, or the folder of a run.
            robot: The robot of the team that it is, from 0.
            measured: Sensors and state that it is given, though it could compute or keep them itself.
            remembered: State that it keeps itself, though it could be given.
            not_finite: Whether numbers that are not finite are refused, or used as episodes do and counted.
            seed: Seed of the draws in constants and in actions.
            set: Values that replace those of the spec.

        Raises:
            SpecError: with all mistakes of the spec.
            HolesLeft: the spec has holes.
            NotMeasured, NotRemembered: a name is of nothing that can be measured or remembered.
            BadInput: the team has no such robot.
        """
        meaning = loaded_from(spec, seed, set).meaning
        design = design_of(meaning, architecture_of(meaning), measured, remembered)
        self._make(design, robot, not_finite, seed)

    @classmethod
    @checked()
    def team(
        cls,
        spec: AnySpec,
        *,
        measured: Collection[str] = (),
        remembered: Collection[str] = (),
        not_finite: NotFinite = "refuse",
        seed: int = 0,
        set: Assignments = (),
    ) -> tuple[Agent, ...]:
        """Return the agents of all robots of a team, sooner than one after the other; all else is as of one agent."""
        meaning = loaded_from(spec, seed, set).meaning
        design = design_of(meaning, architecture_of(meaning), measured, remembered)
        return cls.of(design, not_finite=not_finite, seed=seed)

    @classmethod
    @checked(design=instance(Design))
    def of(cls, design: Design, *, not_finite: NotFinite = "refuse", seed: int = 0) -> tuple[Agent, ...]:
        """Return the agents of all robots with a design."""
        agents = tuple(cls.__new__(cls) for _ in range(design.n_robots))
        for robot, agent in enumerate(agents):
            agent._make(design, robot, not_finite, seed)
        return agents

    def _make(self, design: Design, robot: int, not_finite: NotFinite, seed: int) -> None:
        self._design, self._program = design, program_of(design, robot)
        environment = design.meaning.spec.environment
        self._known = {*environment.world, *environment.state, *environment.sensors}
        if environment.outside is not None:
            self._known |= {*environment.outside.names}
        self._make_functions()
        self._refuses, self._seed_key = not_finite == "refuse", fold(seed_key(seed), name_word("agent"))
        self._many: Many | None = None
        self.not_finite = 0
        self.episode = -1
        self.reset()

    def _make_functions(self) -> None:
        self._functions = plain_functions(self._program, self._known, self._not_finite)
        self._run = self._functions["run"]

    def __getstate__(self) -> dict[str, Any]:
        """Return all but the functions, which a copy in this or another process makes anew."""
        return {name: value for name, value in vars(self).items() if name not in ("_functions", "_run")}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Become a copy, which goes on from where the other one is."""
        vars(self).update(state)
        self._make_functions()

    @property
    def name(self) -> str:
        """The design's name."""
        return self._program.controller.name

    @property
    def digest(self) -> str:
        """The digest of the design, the same as in its exports."""
        return self._program.controller.digest

    @property
    def inputs(self) -> Mapping[str, AgentInput]:
        """What `act` must be given, by name."""
        return self._program.inputs

    @property
    def actions(self) -> tuple[tuple[str, str], ...]:
        """The behavior and the name of each action; that of number k is at k - 1."""
        return tuple((each.behavior, each.name) for each in self._program.controller.actions)

    @property
    def memory(self) -> dict[str, SetValue]:
        """What the agent keeps at the moment: state by name, of lists nested lists; what was before, as `before x`."""
        kept, named = list[SetValue](), self._program.named
        for slot, value in zip(self._program.kept, self._kept, strict=True):
            names = named.get(plain_name(slot.name))
            kept.append(value if names is None else names[int(value)])
        variables = [slot.variable for slot in self._program.kept]
        return by_name(variables, kept, self._program.lengths, lambda values: values)

    @checked(key=optional(whole(0, MOST_SEED)))
    def reset(self, *, key: int | None = None) -> None:
        """Begin a new episode: forget what is kept, and count steps from 1 again.

        Args:
            key: The episode's key of random streams, for designs that draw in actions; by default one for each episode.
        """
        self.episode += 1
        self.step = 0
        self._key = fold(self._seed_key, self.episode) if key is None else key
        self._kept: Kept = self._program.start
        self._seen: tuple[tuple[Any, ...], Kept] | None = None

    def act(self, given: Mapping[str, Any]) -> Act:
        """Return what the robot does, and keep what it has to.

        Args:
            given: A value for each of `inputs`; names of the spec that are no inputs are not looked at.

        Raises:
            BadInput: a name is missing or unknown, or a value of a wrong kind; nothing has changed then.
        """
        before = self._kept
        act, self._kept, values = self._run(given, before, self.step + 1, self._key)
        self.step += 1
        self._seen = values, before
        found: Act = act
        return found

    def act_many(self, given: Mapping[str, Any], *, n: int | None = None) -> Acts:
        """Return what many robots with this design do, each with a memory of its own; compiled when first called.

        Args:
            given: For each of `inputs` an array whose first axis is the robots', or one value for all of them.
            n: The number of robots, where no array says it.

        Raises:
            BadInput: a name is missing or unknown, a value of a wrong kind, or the number of robots has changed since
                the last `reset_many`; nothing has changed then.
        """
        from bbsd.agent.many import Many, rows_of

        rows = rows_of(self.inputs, self._known, given, n)
        self._count_not_finite(rows)
        if self._many is None:
            self._many = Many(
                self._program, [float(each) for each in self._program.start], self._seed_key, rows.shape[1]
            )
        elif self._many.n != rows.shape[1]:
            error = BadInput(f"there were {self._many.n} robots, and {rows.shape[1]} are given")
            error.advice = "call reset_many() before another number of robots"
            raise error
        return self._many.act(rows)

    def reset_many(self, where: npt.ArrayLike | None = None) -> None:
        """Begin new episodes of the robots of `act_many`.

        Args:
            where: Which of them, as truths (n,) or indices; by default all, and there may be another number then.
        """
        if where is None or self._many is None:
            self._many = None
            return
        chosen = np.zeros(self._many.n, np.bool_)
        try:
            chosen[np.asarray(where)] = True
        except (IndexError, ValueError, TypeError):
            raise BadInput(
                f"where are truths of {self._many.n} robots, or their indices, not {where!r:.60}"
            ) from None
        self._many.reset(chosen)

    def _count_not_finite(self, rows: npt.NDArray[np.float64]) -> None:
        wrong = np.argwhere(~np.isfinite(rows))
        if len(wrong) and self._refuses:
            names = [called for each in self.inputs.values() for called in each.called]
            row, robot = wrong[0]
            raise BadInput(f"{names[row]} of robot {robot}: {float(rows[row, robot])!r} is not finite")
        self.not_finite += len(wrong)

    def _not_finite(self, name: str, value: float) -> float:
        if self._refuses:
            raise BadInput(f"{name}: {value!r} is not finite")
        self.not_finite += 1
        return value

    @property
    def why(self) -> str:
        """Why the last action was chosen, in words: what each layer perceived and wanted, and which one controlled."""
        from bbsd.explanation.why import answer_text

        return answer_text(self.answer())

    @checked()
    def answer(self, *, unwanted: Collection[str] = (), wanted: Collection[str] = ()) -> Answer:
        """Return why the last action was chosen, as `bbsd.why` does.

        Args:
            unwanted: Actions or behaviors; for each, what would have had to be different for it not to control.
            wanted: Actions or behaviors; for each, what would have had to be different for it to control.

        Raises:
            NothingDone: `act` has not been called since the agent was made or reset.
        """
        from bbsd.agent.reasons import situation_of
        from bbsd.explanation.why import answer_of

        if self._seen is None:
            raise NothingDone("the agent has done nothing yet")
        values, kept = self._seen
        cells = self._functions["cells"](*values, *kept, self.step, self._key)
        return answer_of(
            self._design.meaning,
            self._design.architecture,
            situation_of(self._design.meaning, self._program, cells, (*values, *kept)),
            self._program.robot,
            step=self.step,
            unwanted=tuple(unwanted),
            wanted=tuple(wanted),
        )

    def __repr__(self) -> str:
        return f"<Agent of {self.name}: {', '.join(self.inputs) or 'no inputs'}>"
