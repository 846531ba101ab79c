"""The kinds of mistakes that are found when a file is read as YAML; the first were BB001 to BB018."""

from __future__ import annotations

from bbsd.errors.kinds.kind import DiagnosisKind

TEXT_KINDS = (
    DiagnosisKind(
        code="BB001",
        title="the file cannot be read",
        explanation="There is no file of that name, it is a folder, or it may not be opened.",
        example="bbsd check lifting.yml",
        mend="bbsd check lifting.yaml",
    ),
    DiagnosisKind(
        code="BB002",
        title="the file is too large",
        explanation="A spec may have 1 MB; the ones people write have a few kilobytes.",
        example="a file of 3 MB",
        mend="Let expressions, such as list(... for i in range(n)), make the large tables.",
    ),
    DiagnosisKind(
        code="BB003",
        title="not a text",
        explanation="A spec is text in UTF-8 without control characters other than tabs and line breaks.",
        example="a file saved as UTF-16 or Latin-1",
        mend="Save the file as UTF-8.",
    ),
    DiagnosisKind(
        code="BB004",
        title="not YAML",
        explanation=(
            "The text breaks YAML's grammar. Often an expression begins with a character that has a "
            "meaning in YAML (> % @ * & [ { - ! |), holds a colon followed by a blank, or has an index "
            "inside {...}: quote it. Otherwise a bracket or quote is not closed, a colon is missing, or"
            " a line is not indented as its neighbors are."
        ),
        example="excited: [1, 2][mode] > 0",
        mend='excited: "[1, 2][mode] > 0"',
    ),
    DiagnosisKind(
        code="BB005",
        title="a tab where blanks are expected",
        explanation=(
            "YAML shows what belongs to what by indenting with blanks; tabs have no agreed width and "
            "are not allowed."
        ),
        example="state:\n\theight: 0",
        mend="state:\n  height: 0",
    ),
    DiagnosisKind(
        code="BB006",
        title="a key given twice",
        explanation=(
            "A mapping has each key once. Which of two was meant cannot be known, so none is silently "
            "dropped."
        ),
        example="state:\n  speed: 0\n  speed: 1",
        mend="state:\n  speed: 1",
    ),
    DiagnosisKind(
        code="BB007",
        title="a merge key",
        explanation=(
            "<< was an addition to YAML 1.1; in YAML 1.2, which specs are written in, it has no meaning."
        ),
        example="slow: &slow\n  excited: tilted\nfast:\n  <<: *slow",
        mend="slow:\n  excited: &when tilted\nfast:\n  excited: *when",
    ),
    DiagnosisKind(
        code="BB008",
        title="a key that is not a text",
        explanation="Keys are names. A number, true, false, null, a list or a mapping can be none.",
        example="place:\n  1: height < 2",
        mend="place:\n  low: height < 2",
    ),
    DiagnosisKind(
        code="BB009",
        title="a tag",
        explanation=(
            "YAML's tags (!name) can ask a reader to make objects or run code. A spec is plain data and"
            " has none."
        ),
        example="excited: !tilted",
        mend="excited: not tilted",
    ),
    DiagnosisKind(
        code="BB010",
        title="an alias without an anchor",
        explanation=(
            "*name repeats the value that was marked with &name earlier in the file. No value is so "
            "marked, or the alias stands inside it. If an expression was meant, it cannot begin with an"
            " asterisk."
        ),
        example="inputs: *seen",
        mend="inputs: &seen [tilted]      # at the first behavior\ninputs: *seen      # at the others",
    ),
    DiagnosisKind(
        code="BB011",
        title="too many values",
        explanation=(
            "A spec may hold 50 000 keys and values, with aliases expanded, so that no small file can "
            "exhaust the machine."
        ),
        example="a: &a [x, x, x, x]\nb: &b [*a, *a, *a, *a]\nc: &c [*b, *b, *b, *b]      # and so on",
        mend="Give the value by an expression.",
    ),
    DiagnosisKind(
        code="BB012",
        title="nested too deeply",
        explanation="Mappings and lists may stand inside each other 40 levels deep, with aliases expanded.",
        example="a: [[[[...]]]]",
        mend="a: [1, 2, 3]",
    ),
    DiagnosisKind(
        code="BB013",
        title="too long a text or number",
        explanation="A text may have 10 000 characters, but for a table, and a number 100.",
        example="mass: 1000000...      # a thousand digits",
        mend="mass: 1e6",
    ),
    DiagnosisKind(
        code="BB014",
        title="not a mapping",
        explanation="A spec is a mapping from keys such as bbsd, name and behaviors to their values.",
        example="- behaviors\n- reward",
        mend="bbsd: 1\nname: lifting",
    ),
    DiagnosisKind(
        code="BB015",
        title="several documents",
        explanation=(
            "YAML can hold several documents in one file, separated by ---. A spec is one document."
        ),
        example="name: one\n---\nname: two",
        mend="name: one      # and the other in its own file",
    ),
    DiagnosisKind(
        code="BB016",
        title="a comma ends a value",
        explanation=(
            "Inside {...} and [...] YAML takes a comma as the end of a text that is not quoted, even "
            "between parentheses."
        ),
        example="actions: {cap: {speed: min(speed, top)}}",
        mend="actions:\n  cap:\n    speed: min(speed, top)",
    ),
    DiagnosisKind(
        code="BB017",
        title="no blank after a colon",
        explanation=(
            "A key is followed by a colon and a blank. Without the blank YAML reads all of it as one text."
        ),
        example="state:\n  speed:0",
        mend="state:\n  speed: 0",
    ),
    DiagnosisKind(
        code="BB018",
        title="an empty block of text",
        explanation=(
            "A value that begins with > or | announces a text on the lines below it, and there is none."
        ),
        example="reached: >3",
        mend='reached: ">3"',
    ),
)
