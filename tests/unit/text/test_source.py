from pathlib import Path

import pytest

from bbsd.errors import Diagnosis, Place, SpecError
from bbsd.text import Source


def refusal(path: Path) -> Diagnosis:
    with pytest.raises(SpecError) as caught:
        Source.read(path)
    (diagnosis,) = caught.value.diagnoses
    return diagnosis


def test_a_file_is_read_as_utf_8(tmp_path: Path) -> None:
    path = tmp_path / "spec.yaml"
    path.write_bytes("name: Größe\n".encode())
    assert Source.read(path) == Source(str(path), "name: Größe\n")


def test_a_byte_order_mark_is_no_part_of_the_text(tmp_path: Path) -> None:
    path = tmp_path / "spec.yaml"
    path.write_bytes(b"\xef\xbb\xbfname: x\n")
    assert Source.read(path).text == "name: x\n"


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    path = tmp_path / "spec.yaml"
    assert refusal(path) == Diagnosis("BB001", "there is no such file", Place(str(path), 1, 1))


def test_a_directory_is_no_file(tmp_path: Path) -> None:
    assert refusal(tmp_path).message == "this is a folder, not a file"


def test_files_in_a_folder_are_named(tmp_path: Path) -> None:
    for name in ("spec.yaml", "architecture.yaml"):
        (tmp_path / name).touch()
    files = f"{tmp_path / 'architecture.yaml'}, {tmp_path / 'spec.yaml'}"
    assert refusal(tmp_path).message == f"this is a folder, not a file; give a file in it: {files}"
    for name in ("x.yaml", "y.yaml"):
        (tmp_path / name).touch()
    assert refusal(tmp_path).message.endswith(f"{files}, {tmp_path / 'x.yaml'} and 1 more")


def test_a_name_that_no_file_can_have_is_a_diagnosis(tmp_path: Path) -> None:
    assert refusal(tmp_path / "a\0b").code == "BB001"
    assert refusal(tmp_path / ("x" * 5000)).code == "BB001"


def test_a_file_of_more_than_a_megabyte_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "spec.yaml"
    path.write_bytes(b"#" * 1_000_000)
    assert len(Source.read(path).text) == 1_000_000
    path.write_bytes(b"#" * 1_000_001)
    assert refusal(path).code == "BB002"


def test_a_byte_that_is_not_utf_8_is_shown_where_it_is(tmp_path: Path) -> None:
    path = tmp_path / "spec.yaml"
    path.write_bytes(b"\xef\xbb\xbfname: x\nsummary: \xc3\xa4 gr\xf6\xdfer\n")
    diagnosis = refusal(path)
    assert (diagnosis.code, diagnosis.message) == ("BB003", "the byte 0xf6 is not UTF-8")
    assert diagnosis.place == Place(str(path), 2, 14)


@pytest.mark.parametrize("line_break", ["\n", "\r\n", "\r"])
def test_lines_are_counted_from_one_whatever_ends_them(line_break: str) -> None:
    source = Source("spec.yaml", line_break.join(["one", "", "three"]))
    assert [source.line(number) for number in range(5)] == ["", "one", "", "three", ""]
    start = source.text.index("three")
    assert source.place(start, start + 5) == Place("spec.yaml", 3, 1, 5)


def test_a_place_ends_with_its_line() -> None:
    assert Source("s", "one two\r\nthree").place(4, 12) == Place("s", 1, 5, 3)


def test_the_end_of_the_text_has_a_place() -> None:
    assert Source("s", "one\n").place(4) == Place("s", 2, 1, 1)
    assert Source("s", "").place(0) == Place("s", 1, 1, 1)


def test_line_separators_of_unicode_do_not_end_a_line() -> None:
    assert Source("s", "a\u2028b\x85c").line(1) == "a\u2028b\x85c"
