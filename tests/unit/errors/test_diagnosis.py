import pickle

from bbsd.errors import Diagnosis, Place, SpecError
from bbsd.text import Source

MISTAKES = (
    Diagnosis("BB006", "the key is given twice", Place("spec.yaml", 3, 1, 4)),
    Diagnosis("BB012", "nested too deeply", Place("spec.yaml", 7, 2)),
)


def test_an_error_lists_all_its_diagnoses() -> None:
    error = SpecError(MISTAKES, Source("spec.yaml", "text"))
    assert str(error) == (
        "spec.yaml:3:1: error[BB006]: the key is given twice\nspec.yaml:7:2: error[BB012]: nested too deeply"
    )


def test_an_error_survives_the_way_between_processes() -> None:
    error = pickle.loads(pickle.dumps(SpecError(MISTAKES, Source("spec.yaml", "text"))))
    assert error.diagnoses == MISTAKES
    assert error.source.line(1) == "text"
