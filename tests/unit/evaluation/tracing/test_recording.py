import numpy as np

from bbsd.architecture import architecture_of
from bbsd.compiler import compile_meaning
from bbsd.evaluation import trace
from bbsd.evaluation.tracing.recording import record_episode
from tests.unit.architecture.designs import meaning_of, shipped


def test_a_recording_has_the_numbers_of_the_trace():
    meaning = meaning_of(shipped("object_lifting_hand"))
    problem, design = compile_meaning(meaning, compiled=False), architecture_of(meaning)
    recording, traced = record_episode(problem, design, 3, 1), trace(problem, design, 3, 1)
    assert len(recording.stored) == len(recording.choices) == len(traced.steps)
    names = ["", *(action for module in meaning.episode.modules for action in module.actions)]
    for robot, actions in enumerate(traced.actions):
        assert [names[choice] for choice in recording.choices[:, robot]] == actions
    for step in (1, 2, 300):
        before = traced.before(step)
        stored = recording.stored[step - 1]
        assert stored.keys() <= before.keys()
        heights = [slot for slot in stored if slot.name in ("height", "speed", "tilt")]
        assert len(heights) == 9
        assert np.array_equal([stored[slot] for slot in heights], [before[slot] for slot in heights])
