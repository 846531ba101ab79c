import re
import subprocess

import numpy as np
import pytest

from bbsd.architecture import joint_space
from bbsd.architecture.deciding import policy_at
from bbsd.exports.c import write
from bbsd.exports.exported import Options
from bbsd.exports.verification.comparing import cells_to_compare
from bbsd.exports.verification.compilers import STRICT, compiled_answers, run_gcc
from bbsd.exports.verification.tools import folder_of
from tests.unit.exports.designs import ODD_NAME, ODD_WORDS, SHIPPED, answers, drawn, hand_made, tool, written

SANITIZED = (*STRICT, "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
CPP = ("-x", "c++", "-std=c++11", "-Wall", "-Wextra", "-Werror", "-Wno-old-style-cast")


def sanitized(_, files, cells):
    return compiled_answers(files, cells, "gcc", SANITIZED)


def as_cpp(_, files, cells):
    return compiled_answers(files, cells, "gcc", CPP)


def agrees(run, exported, cells=None):
    """Whether the header answers as the design does, and how many different answers there are."""
    cells = cells_to_compare(exported) if cells is None else cells
    expected = policy_at(joint_space(exported.meaning), exported.architecture, cells)
    found_answers = answers(run, exported, write(exported, Options()), cells)
    assert found_answers.tolist() == expected.tolist()
    return len(np.unique(expected))


@pytest.mark.slow
@pytest.mark.parametrize("name", SHIPPED)
def test_a_header_decides_in_all_joint_cells_as_the_design_without_a_warning(name):
    assert agrees(sanitized, hand_made(name)) > 1


@pytest.mark.parametrize("seed", range(2))
def test_drawn_tables_and_layers_are_written_as_they_are(seed):
    assert agrees(run_gcc, drawn("mobile_robot", seed)) > 1


@pytest.mark.parametrize("run", [sanitized, as_cpp])
def test_whatever_things_are_called_it_is_a_header(run):
    assert agrees(run, written(ODD_WORDS, name=ODD_NAME)) > 2


LARGE = """
  wide:
    inputs: {{small: x > 5, far: "values(floor(x), 0, {last})"}}
    actions: {{go: {{x: 1}}, stop: {{x: 2}}}}
    rules: [{{when: {{far: {last}, small: true}}, do: stop}}, {{when: {{far: 7}}, do: go}}, {{otherwise: no action}}]
structure: [wide]
"""


@pytest.mark.parametrize("last", [32_767, 65_535, 65_536])
def test_tables_that_16_bits_cannot_index_are_read_right(last):
    exported = written(LARGE.format(last=last))
    (text,) = write(exported, Options()).values()
    assert ("uint32_t far" in text) is (last > 65_535)
    assert ("(uint32_t)small * " in text) is (last > 32_767)
    cells = np.array([[small, far] for small in (0, 1) for far in (0, 6, 7, 8, last - 1, last)])
    assert agrees(sanitized, exported, cells) == 3


def test_without_layers_or_inputs_there_is_still_a_function():
    never = "  a: {excited: 1 > 2, actions: {go: {x: 1}}, rules: [{otherwise: go}]}\nstructure: [a]\n"
    always = "  a: {actions: {go: {x: 1}}, rules: [{otherwise: go}]}\nstructure: [a]\n"
    assert agrees(run_gcc, written(never)) == 1
    assert agrees(run_gcc, written(always)) == 1


def test_a_cell_that_does_not_exist_is_nobodys():
    exported = hand_made("object_lifting_hand")
    cells = np.array([[5, 0, 0, 0], [6, 0, 0, 0], [0, 0, 3, 1], [0, 9, 0, 0]])
    assert answers(sanitized, exported, write(exported, Options()), cells).tolist()[1:] == [0, 0, 0]


def test_a_header_is_small():
    """The figure that the documentation states; without tables in memory that can be written."""
    files = write(hand_made("mobile_robot_hand"), Options())
    (header,) = files
    source = f'#include "{header}"\nint f(unsigned, unsigned, unsigned, unsigned, unsigned, unsigned);\n'
    source += (
        "int f(unsigned a, unsigned b, unsigned c, unsigned d, unsigned e, unsigned g)\n"
        "{ return (int)mobile_robot_by_hand_command(a, b, c, d, e, g); }\n"
    )
    with folder_of({**files, "f.c": source}) as folder:
        flags = ["-std=c99", "-Os", "-fno-asynchronous-unwind-tables", "-c", "f.c", "-o", "f.o"]
        subprocess.run([tool("gcc"), *flags], cwd=folder, check=True)
        said = subprocess.run([tool("size"), "f.o"], cwd=folder, check=True, capture_output=True, text=True)
    text, data, bss = map(int, said.stdout.splitlines()[1].split()[:3])
    assert 50 < text < 200
    assert (data, bss) == (0, 0)


AVR = """
#define PROGMEM __attribute__((section(".progmem")))
#define pgm_read_byte(place) (reads++, *(place))
static unsigned reads;
"""


def test_on_an_avr_tables_are_read_from_flash():
    exported = hand_made("object_lifting_hand")
    files = write(exported, Options())
    (header,) = files
    source = f'#include "{header}"\n#include <stdio.h>\n'
    source += 'int main(void) { printf("%d", (int)object_lifting_by_hand_command(5, 0, 2, 0)); return reads != 4; }\n'
    with folder_of({**files, "main.c": source}) as folder:
        (folder / "avr").mkdir()
        (folder / "avr" / "pgmspace.h").write_text(AVR)
        flags = [*STRICT, "-Wno-variadic-macros", "-D__AVR__", "-I.", "main.c", "-o", "main"]
        subprocess.run([tool("gcc"), *flags], cwd=folder, check=True)
        said = subprocess.run([folder / "main"], cwd=folder, check=True, capture_output=True, text=True)
    assert said.stdout == "2"


def test_it_says_what_each_layer_does_and_which_design_it_was():
    exported = hand_made("object_lifting_hand")
    (text,) = write(exported, Options()).values()
    assert exported.controller.digest in text
    assert re.search(r"Layer 4, slow_down:\n +\*   slower where place is highest and tilted \*/", text)
    assert "/* speed = min(speed, top_speed) */\n    OBJECT_LIFTING_BY_HAND_DO_NOT_GO_FAST_CAP = 2" in text
    assert "pace: the number of values(speed, 0, 5)" in text
