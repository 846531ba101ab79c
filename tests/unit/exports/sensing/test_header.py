import re
import subprocess

import pytest

from bbsd.exports.c import RESERVED
from bbsd.exports.exported import Options, exported_design
from bbsd.exports.sensing.header import sensing_of, write
from bbsd.exports.sensing.naming import Namer
from bbsd.exports.verification.compilers import STRICT
from bbsd.exports.verification.tools import folder_of
from tests.unit.architecture.designs import meaning_of, random_architecture
from tests.unit.exports.designs import tool, written
from tests.unit.exports.sensing.robots import robots, shipped


def sensing(exported, **options):
    return sensing_of(exported, Options(sensing=True, **options))


def members(exported, **options):
    """The declarations of each struct."""
    found = sensing(exported, **options).members
    return {name: [member.declaration for member in each] for name, each in found.items()}


def said_by_gcc(text, *flags):
    """What gcc says of a program that includes a header; nothing where it has no objection."""
    gcc = tool("gcc")
    with folder_of(
        {"design.h": text, "program.c": '#include "design.h"\nint main(void) { return 0; }\n'}
    ) as folder:
        words = [gcc, *flags, "-fsyntax-only", "program.c"]
        return subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False).stderr


def test_without_sensing_the_header_is_as_it_was():
    exported = shipped("object_lifting_hand")
    ((name, plain),) = write(exported, Options()).items()
    ((same_name, text),) = write(exported, Options(sensing=True)).items()
    assert name == same_name
    assert text.startswith(plain)
    assert "double" not in plain


def test_what_is_given_kept_and_set_are_members():
    assert members(robots(3)) == {
        "inputs": [
            "double lamp;",
            "double place[3];",
            "double clock;",
            "double noisy;",
            "double random_1;",
            "double random_2;",
            "double random_3;",
            "double random_4;",
        ],
        "memory": [
            "double speed;",
            "double charge;",
            "double turns;",
            "double before_light_1;",
            "int robot;",
            "double step;",
        ],
        "outputs": ["double speed;", "double charge;", "double turns;", "bool signal;"],
    }


def test_what_is_measured_is_given_as_it_is_sensed():
    found = members(robots(1), measured=["light", "shape", "field", "rising"])
    given = [each for each in found["inputs"] if "random" not in each]
    assert given == [
        "double place;",
        "double clock;",
        "double light[2];",
        "double noisy;",
        "bool rising;",
        "int field;",
        "int shape;",
    ]
    assert not any("before" in each for each in found["memory"])


def test_a_design_that_needs_nothing_is_a_function_without_arguments():
    exported = written("  go: {actions: {go: {x: 1}}, rules: [{otherwise: go}]}\nstructure: [go]\n")
    text = sensing(exported, remembered=()).text()
    assert "small_step(\n    struct small_memory *memory,\n    struct small_outputs *outputs)" in text
    empty = written("  go: {actions: {go: {}}, rules: [{otherwise: go}]}\nstructure: [go]\n")
    assert "small_step(\n    void)" in sensing(empty).text()


def test_only_what_is_used_is_printed():
    text = sensing(shipped("tasks/mountain_car_hand")).text()
    used = set(re.findall(r"\bbbsd_\w+", text))
    defined = set(re.findall(r"static inline \w+ (bbsd_\w+)\(", text))
    assert used == defined
    declared = re.findall(r"const double (\w+) =", text)
    assert all(len(re.findall(rf"\b{name}\b", text)) > 1 for name in declared)


@pytest.mark.parametrize("measured", [(), ("light",), ("light", "ahead", "tired")])
def test_there_is_no_warning_however_much_is_left_out(measured):
    ((_, text),) = write(robots(2), Options(sensing=True, measured=measured)).items()
    assert said_by_gcc(text, *STRICT, "-Wunused", "-Wshadow", "-O2") == ""


@pytest.mark.parametrize(
    ("flags", "said"),
    [(("-ffast-math",), "-ffast-math would change results"), (("-mfpmath=387",), "rounded to binary64")],
)
def test_arithmetic_with_other_bits_is_refused(flags, said):
    ((_, text),) = write(shipped("tasks/mountain_car_hand"), Options(sensing=True)).items()
    assert said in said_by_gcc(text, "-std=c99", *flags)


def test_a_double_that_is_not_binary64_is_refused():
    ((_, text),) = write(shipped("tasks/mountain_car_hand"), Options(sensing=True)).items()
    short = text.replace("DBL_MANT_DIG", "FLT_MANT_DIG")  # as where a double has 32 bits
    assert "double is not binary64 here" in said_by_gcc(short, "-std=c99")


def test_headers_of_two_designs_go_into_one_program():
    first, second = (
        next(iter(write(shipped(name), Options(sensing=True)).values()))
        for name in ("object_lifting_hand", "pursuit_hand")
    )
    assert said_by_gcc(first + second + first, *STRICT) == ""


ODD = """
bbsd: 1
name: odd
environment:
  steps: 3
  state:
    int: 0
    double: uniform(0, 1)
    fabs: uniform(0, 1)
    inputs: 1
    part_1: 2
    memory_: uniform(1, 2)
  sensors:
    action_1: fabs * fabs - int
    struct: {"*/ a??/": fabs > 0.5, "/* b": otherwise}
    far: hypot(double, memory_) > 1
behaviors:
  switch:
    inputs: [struct, far]
    excited: action_1 > 0 and part_1 == 2
    actions:
      return: {int: int + 1, inputs: fabs}
    rules: [{otherwise: return}]
structure: [switch]
reward: {up: int}
"""


def test_whatever_things_are_called_it_compiles():
    meaning = meaning_of(ODD)
    exported = exported_design(meaning, random_architecture(meaning, 0))
    ((_, text),) = write(exported, Options(sensing=True)).items()
    assert said_by_gcc(text, *STRICT) == ""


def test_names_are_none_of_c():
    namer = Namer()
    assert [namer("double"), namer("double"), namer("speed"), namer("fabs")] == [
        "double_",
        "double__",
        "speed",
        "fabs_",
    ]
    assert namer.numbered("part") == "part_1"
    assert namer.inner()("part_1") == "part_1_"
    assert {"int", "bool", "struct"} <= RESERVED
