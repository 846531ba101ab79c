"""Worlds that exist twice: written in the language, and stepped in Python, with the same numbers to the last bit."""

import numpy as np

from bbsd.expression.node_data import Slot
from bbsd.kernel import functions
from bbsd.kernel.streams import fold, integers, uniform, word_of
from tests.unit.architecture.designs import meaning_of

CORRIDOR = """
bbsd: 1
name: corridor
environment:
  robots: 2
  steps: 9
  {world}
  sensors:
    charger: {{left: place > 7, here: place == 7, right: otherwise}}
    tired: work > 5
behaviors:
  go_left:
    inputs: [charger]
    actions: {{left: {{command: -1}}, far: {{command: -2}}}}
    expects: place < before(place)
  go_right:
    inputs: [charger, tired]
    actions: {{right: {{command: 1}}}}
reward: {{{reward}, effort: -0.1 * abs(command)}}
"""
"""Two robots on a corridor of ten places with a charger at the seventh; at the end of it they fall, and it is over."""

CORRIDOR_INSIDE = CORRIDOR.format(
    world="""\
state: {place: "integers(0, 9)", command: 0, work: 0, before_last: 0}
  dynamics:
    place: max(place + command, 0)
    work: work + abs(command)
    before_last: place
  ends: any(place[r] > 9 for r in team)""",
    reward="there: 1 if place == 7 else 0",
)
CORRIDOR_OUTSIDE = CORRIDOR.format(
    world="""\
python: corridors:Corridor
  observation: [place]
  action: command
  state: {command: 0, work: 0, before_last: 0}
  dynamics: {work: work + abs(command), before_last: place}""",
    reward="there: earned",
)

CARTPOLE_OUTSIDE = """
bbsd: 1
name: cartpole
environment:
  python: poles:Pole
  steps: 60
  observation: [x, speed, angle, turning]
  action: push
  state: {push: -1}
  sensors:
    lean: cut(angle, -0.05, 0, 0.05)
    swing: cut(turning, -0.5, 0, 0.5)
    drift: cut(x, -1, 1)
behaviors:
  balance:
    inputs: [lean, swing]
    actions: {left: {push: -1}, right: {push: 1}}
  center:
    inputs: [drift, lean]
    actions: {left: {push: -1}, right: {push: 1}}
reward: {up: earned}
"""


class Drawn:
    """What a world in the language draws at its start, for other keys in the same way."""

    def __init__(self, text, names, robots=1):
        start = meaning_of(text).episode.start
        self.words = [
            [start[Slot(name, robot)].draw.kernel_word for robot in range(robots)] for name in names
        ]

    def __call__(self, draw, key, low, high):
        return [[draw(key, fold(word, word_of(0)), low, high) for word in words] for words in self.words]


class Corridor:
    """The corridor as a stepper, with a world in each lane."""

    drawn = Drawn(CORRIDOR_INSIDE, ["place"], 2)

    def __init__(self):
        self.places, self.steps, self.over = {}, 0, set()

    def reset(self, lanes, keys, outside):
        for lane in lanes:
            self.places[lane] = np.array(self.drawn(integers, int(keys[lane]), 0.0, 9.0)[0])
            outside[:, lane] = [*self.places[lane], 0.0, 0.0, 0.0]
        self.over -= set(lanes)

    def step(self, lanes, sent, outside):
        assert self.over.isdisjoint(lanes), "a lane that is over is not stepped"
        for lane in lanes:
            self.steps += 1
            places = self.places[lane] = np.maximum(self.places[lane] + sent[:, lane], 0.0)
            ended = float(any(places > 9))
            outside[:, lane] = [*places, *(places == 7), ended]
            self.over |= {lane} if ended else set()


class Pole:
    """The pole on a cart of `specs/tasks/cartpole.yaml` as a stepper."""

    def __init__(self, drawn):
        self.drawn, self.values = drawn, {}

    def reset(self, lanes, keys, outside):
        for lane in lanes:
            self.values[lane] = [value for (value,) in self.drawn(uniform, keys[lane], -0.05, 0.05)]
            outside[:, lane] = [*self.values[lane], 0.0, 0.0]

    def step(self, lanes, sent, outside):
        for lane in lanes:
            x, speed, angle, turning = self.values[lane]
            mass, moment, cosine = 1.0 + 0.1, 0.1 * 0.5, functions.cos(angle)
            thrust = (sent[0, lane] * 10.0 + moment * (turning * turning) * functions.sin(angle)) / mass
            lever = 0.5 * (4.0 / 3.0 - 0.1 * (cosine * cosine) / mass)
            angle_gain = (9.8 * functions.sin(angle) - cosine * thrust) / lever
            speed_gain = thrust - moment * angle_gain * cosine / mass
            x, angle = x + 0.02 * speed, angle + 0.02 * turning
            speed, turning = speed + 0.02 * speed_gain, turning + 0.02 * angle_gain
            self.values[lane] = [x, speed, angle, turning]
            ended = abs(x) > 2.4 or abs(angle) > functions.radians(12.0)
            outside[:, lane] = [x, speed, angle, turning, 1.0, float(ended)]
