"""Specs that exhaust a careless reader's memory or time: large, deep, or with parts that multiply."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fuzzing.damage import NAMES, random_data, yaml_text

if TYPE_CHECKING:
    import random
    from collections.abc import Callable

    Kind = Callable[[int, random.Random], str]
    """Maps a size and a random generator to a spec."""

MEGABYTE = 1_000_000


def spec(
    constants: str = "", robots: int = 2, state: str = "", definitions: str = "", sensors: str = "",
    behaviors: str = "  go:\n    actions: {run: {speed: 1}}\n", reward: str = "speed", more: str = "",
) -> str:  # fmt: skip
    """Return a small spec around its large part; each part is the lines of its block."""
    return (
        f"bbsd: 1\nname: heavy\nconstants:\n  one: 1\n{constants}environment:\n  robots: {robots}\n  steps: 10\n"
        f"  state:\n    speed: 0\n{state}  definitions:\n    own: speed\n{definitions}  sensors:\n    fast: speed > 1\n"
        f"{sensors}behaviors:\n{behaviors}reward:\n  good: {reward}\n{more}"
    )


def _lines(n: int, line: Callable[[int], str], indent: int = 4) -> str:
    return "".join(f"{' ' * indent}{line(k)}\n" for k in range(n))


def doubling(n: int, dice: random.Random) -> str:
    """Return a spec with a chain of definitions that each use the one before twice."""
    sign = dice.choice("+*-/")
    chain = _lines(n, lambda k: f"d{k + 1}: d{k} {sign} d{k}" if k else "d1: speed + speed")
    return spec(definitions=chain, reward=f"d{n}")


def parameters(n: int, dice: random.Random) -> str:
    """Return a spec with a chain of definitions with parameters that each call the one before twice."""
    calls = dice.choice(("f{0}(a + 1) + f{0}(a + 2)", "f{0}(f{0}(a))", "f{0}(a) * f{0}(-a)"))
    chain = _lines(n, lambda k: f"f{k + 1}(a): {calls.format(k)}" if k else "f1(a): a + speed")
    return spec(definitions=chain, reward=f"f{n}(1)")


def sensors(n: int, dice: random.Random) -> str:
    """Return a spec with a chain of sensors that each need the one before, for many robots."""
    of = dice.choice(("s{0} + 1", "max(s{0}[r] for r in team)", "s{0} + normal(0, 1)", "before(s{0})"))
    chain = _lines(n, lambda k: f"s{k + 1}: {of.format(k)}" if k else "s1: speed")
    return spec(robots=dice.choice((1, 8, 64)), sensors=chain)


def generators(n: int, dice: random.Random) -> str:
    """Return a spec with generators inside generators."""
    size = dice.choice((2, 10, 64, 1000))
    inner = "speed"
    for depth in range(min(n, 12)):
        inner = f"sum({inner} + i{depth} for i{depth} in range({size}))"
    return spec(robots=dice.choice((1, 64)), reward=inner)


def tables(n: int, dice: random.Random) -> str:
    """Return a spec with a table of numbers, drawn or written out, and a reward that reads it."""
    width = dice.choice((1, 30, 1000))
    rows = max(1, n // width)
    written = f"  table: [{', '.join([str(list(range(width)))] * rows)}]\n"
    drawn = f"  table: list(list(integers(0, 9) for i in range({width})) for j in range({rows}))\n"
    return spec(
        constants=dice.choice((written, drawn)), reward="sum(sum(x * speed for x in row) for row in table)"
    )


def unknown(n: int, dice: random.Random) -> str:
    """Return a spec with many names, and many misspelled ones."""
    constants = _lines(n, lambda k: f"name_of_a_constant_{k}: {k}", 2)
    terms = _lines(min(n, 300), lambda k: f"term_{k}: nome_of_a_constant_{dice.randrange(10**6)}", 2)
    return spec(constants=constants, more=terms)


def keys(n: int, dice: random.Random) -> str:
    """Return a spec with many unknown keys."""
    return spec(more=_lines(n, lambda k: f"{dice.choice(NAMES[2:6])}{k}: {k}", 0))


def rules(n: int, dice: random.Random) -> str:
    """Return a spec with a large table and many rules that each match much of it."""
    size = dice.choice((2, 100, 999))
    inputs = f"    inputs: {{a: 'values(speed, 0, {size})', b: 'values(speed, 0, {size})'}}\n"
    written = _lines(
        n, lambda k: f"- {{when: {{a: '{k % (size + 1)}'}}, do: {dice.choice(('on', 'open'))}}}", 6
    )
    return spec(behaviors=f"  go:\n{inputs}    actions: {{run: {{speed: 1}}}}\n    rules:\n{written}")


def behaviors(n: int, dice: random.Random) -> str:
    """Return a spec with many behaviors with many actions."""
    actions = ", ".join(f"a{k}: {{speed: {k}}}" for k in range(dice.choice((1, 20, 201))))
    return spec(
        robots=dice.choice((1, 64)), behaviors=_lines(n, lambda k: f"b{k}: {{actions: {{{actions}}}}}", 2)
    )


def symbols(n: int, dice: random.Random) -> str:
    """Return a spec with a table as text of about the right length, alone or repeated by many behaviors."""
    kinds = dice.choice((".1", "01?", ".1?2z", "Àé.1"))
    cells = "".join(dice.choices(kinds, k=n + dice.choice((-1, 0, 0, 1))))
    row = dice.choice((1, 90, 1000, n))
    rows = [cells[start : start + row] for start in range(0, len(cells), row)]
    text = dice.choice(("|", ">", "|-")) + "\n" + "".join(f"      {row}\n" for row in rows)
    behavior = f"    inputs: {{at: 'values(speed, 1, {n})'}}\n    actions: {{run: {{speed: 1}}}}\n    table: "
    repeated = "".join(f"  again{k}:\n{behavior}*cells\n" for k in range(dice.choice((0, 1, 60))))
    anchor = "&cells " if repeated else ""
    return spec(robots=dice.choice((1, 64)), behaviors=f"  go:\n{behavior}{anchor}{text}{repeated}")


def cells(n: int, dice: random.Random) -> str:
    """Return a spec with named cells, whose conditions `check` must prove to cover everything."""
    join = dice.choice((" and ", " or "))
    conditions = join.join(
        f"speed {dice.choice(('<', '>=', '=='))} {k % 7}" for k in range(dice.randint(1, 60))
    )
    named = _lines(n, lambda k: f"c{k}: {conditions if k % 2 else f'speed < {k}'}", 6)
    return spec(sensors=f"    zone:\n{named}")


def cuts(n: int, dice: random.Random) -> str:
    """Return a spec with a cut of many bounds, for many robots."""
    bounds = ", ".join(str(k) for k in range(n))
    return spec(robots=dice.choice((1, 64)), sensors=f"    zone: cut(speed, {bounds})\n")


def long_expression(n: int, dice: random.Random) -> str:
    """Return a spec with one long expression, on one line or many."""
    part = dice.choice(
        (" + speed", " and speed > 1", " if fast else speed", " < 1", "[0]", " ** 2", ".x", "\n      + 1")
    )
    return spec(reward="speed" + part * n)


def deep(n: int, dice: random.Random) -> str:
    """Return a spec with deep nesting, of brackets or of blocks."""
    opening, closing = dice.choice(
        (("[", "]"), ("{a: ", "}"), ("(", ")"), ("- ", ""), ("? ", ""), ("-", ""), ("not ", ""))
    )
    return spec(more="x-deep: " + opening * n + "1" + closing * dice.choice((0, n)))


def aliases(n: int, dice: random.Random) -> str:
    """Return a spec with aliases that multiply, or one that is used often."""
    times = dice.choice((1, 2, 10))
    chain = _lines(n, lambda k: f"x-a{k}: &a{k} [{', '.join([f'*a{k - 1}' if k else 'x'] * times)}]", 0)
    return spec(more=chain)


def numbers(n: int, dice: random.Random) -> str:
    """Return a spec with numbers of many digits, for YAML and in expressions."""
    number = dice.choice(("9", "1_", "0x", "0.", "1e", "-", "0o7")) + dice.choice("0129") * n
    return spec(constants=f"  a: {number}\n  b: one + {number}\n  c: 2 ** {number}\n")


def unicode_names(n: int, dice: random.Random) -> str:
    """Return a spec with names of unusual characters."""
    names = _lines(
        min(n, 2000),
        lambda k: (
            "".join(
                chr(dice.choice((dice.randrange(0x80, 0x3000), dice.randrange(0x10000, 0x110000))))
                for _ in range(k % 9 + 1)
            )
            + ": 1"
        ),
        2,
    )
    return spec(constants=names)


def shapeless(n: int, dice: random.Random) -> str:
    """Return a spec with random data of any shape."""
    return yaml_text(
        {
            "bbsd": 1,
            "name": "x",
            "environment": random_data(dice),
            "behaviors": [random_data(dice) for _ in range(min(n, 50))],
        },
        dice,
    )


def noise(n: int, dice: random.Random) -> str:
    """Return random characters."""
    return "".join(
        chr(dice.choice((10, 32, dice.randrange(32, 127), dice.randrange(1, 0x3000)))) for _ in range(n)
    )


KINDS: tuple[Kind, ...] = (
    doubling, parameters, sensors, generators, tables, unknown, keys, rules, behaviors, symbols, cells, cuts,
    long_expression, deep, aliases, numbers, unicode_names, shapeless, noise,
)  # fmt: skip
SIZES = (1, 10, 40, 100, 1000, 10_000, 100_000)


def heavy_spec(dice: random.Random) -> str:
    """Return a spec of a random kind and size, cut off at 1 MB."""
    return dice.choice(KINDS)(dice.choice(SIZES), dice)[:MEGABYTE]
