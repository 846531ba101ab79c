"""Specs that would exhaust a machine that reads them carelessly: large, deep, and with much to multiply."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fuzzing.damage import NAMES, anything, dumped

if TYPE_CHECKING:
    import random
    from collections.abc import Callable

    Burden = Callable[[int, random.Random], str]

MEGABYTE = 1_000_000


def spec(
    constants: str = "", robots: int = 2, state: str = "", definitions: str = "", sensors: str = "",
    behaviors: str = "  go:\n    actions: {run: {speed: 1}}\n", reward: str = "speed", more: str = "",
) -> str:  # fmt: skip
    """A small spec around what is large in it; each part is the lines of its block."""
    return (
        f"bbsd: 1\nname: burden\nconstants:\n  one: 1\n{constants}environment:\n  robots: {robots}\n  steps: 10\n"
        f"  state:\n    speed: 0\n{state}  definitions:\n    own: speed\n{definitions}  sensors:\n    fast: speed > 1\n"
        f"{sensors}behaviors:\n{behaviors}reward:\n  good: {reward}\n{more}"
    )


def _lines(n: int, line: Callable[[int], str], indent: int = 4) -> str:
    return "".join(f"{' ' * indent}{line(k)}\n" for k in range(n))


def doubling(n: int, dice: random.Random) -> str:
    """Definitions that each use the one before twice."""
    sign = dice.choice("+*-/")
    chain = _lines(n, lambda k: f"d{k + 1}: d{k} {sign} d{k}" if k else "d1: speed + speed")
    return spec(definitions=chain, reward=f"d{n}")


def parameters(n: int, dice: random.Random) -> str:
    """Definitions with parameters that each call the one before with two arguments."""
    calls = dice.choice(("f{0}(a + 1) + f{0}(a + 2)", "f{0}(f{0}(a))", "f{0}(a) * f{0}(-a)"))
    chain = _lines(n, lambda k: f"f{k + 1}(a): {calls.format(k)}" if k else "f1(a): a + speed")
    return spec(definitions=chain, reward=f"f{n}(1)")


def sensors(n: int, dice: random.Random) -> str:
    """Sensors that need each other in a chain, for many robots."""
    of = dice.choice(("s{0} + 1", "max(s{0}[r] for r in team)", "s{0} + normal(0, 1)", "before(s{0})"))
    chain = _lines(n, lambda k: f"s{k + 1}: {of.format(k)}" if k else "s1: speed")
    return spec(robots=dice.choice((1, 8, 64)), sensors=chain)


def generators(n: int, dice: random.Random) -> str:
    """Generators inside generators."""
    size = dice.choice((2, 10, 64, 1000))
    inner = "speed"
    for depth in range(min(n, 12)):
        inner = f"sum({inner} + i{depth} for i{depth} in range({size}))"
    return spec(robots=dice.choice((1, 64)), reward=inner)


def tables(n: int, dice: random.Random) -> str:
    """Tables of numbers, drawn or written out, and what reads them."""
    width = dice.choice((1, 30, 1000))
    rows = max(1, n // width)
    written = f"  table: [{', '.join([str(list(range(width)))] * rows)}]\n"
    drawn = f"  table: list(list(integers(0, 9) for i in range({width})) for j in range({rows}))\n"
    return spec(
        constants=dice.choice((written, drawn)), reward="sum(sum(x * speed for x in row) for row in table)"
    )


def unknown(n: int, dice: random.Random) -> str:
    """Many names, and many that are none."""
    known = _lines(n, lambda k: f"name_of_a_constant_{k}: {k}", 2)
    terms = _lines(min(n, 300), lambda k: f"term_{k}: nome_of_a_constant_{dice.randrange(10**6)}", 2)
    return spec(constants=known, more=terms)


def keys(n: int, dice: random.Random) -> str:
    """Many keys that are none."""
    return spec(more=_lines(n, lambda k: f"{dice.choice(NAMES[2:6])}{k}: {k}", 0))


def rules(n: int, dice: random.Random) -> str:
    """A large table and many rules that each match much of it."""
    size = dice.choice((2, 100, 999))
    inputs = f"    inputs: {{a: 'values(speed, 0, {size})', b: 'values(speed, 0, {size})'}}\n"
    written = _lines(
        n, lambda k: f"- {{when: {{a: '{k % (size + 1)}'}}, do: {dice.choice(('on', 'open'))}}}", 6
    )
    return spec(behaviors=f"  go:\n{inputs}    actions: {{run: {{speed: 1}}}}\n    rules:\n{written}")


def behaviors(n: int, dice: random.Random) -> str:
    """Many behaviors with many actions."""
    actions = ", ".join(f"a{k}: {{speed: {k}}}" for k in range(dice.choice((1, 20, 201))))
    return spec(
        robots=dice.choice((1, 64)), behaviors=_lines(n, lambda k: f"b{k}: {{actions: {{{actions}}}}}", 2)
    )


def symbols(n: int, dice: random.Random) -> str:
    """A table as text, nearly or just as long as it should be, alone or repeated by many behaviors."""
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
    """Named cells with conditions whose cover is to be proven."""
    join = dice.choice((" and ", " or "))
    conditions = join.join(
        f"speed {dice.choice(('<', '>=', '=='))} {k % 7}" for k in range(dice.randint(1, 60))
    )
    named = _lines(n, lambda k: f"c{k}: {conditions if k % 2 else f'speed < {k}'}", 6)
    return spec(sensors=f"    zone:\n{named}")


def cuts(n: int, dice: random.Random) -> str:
    """A cut with many bounds, all for many robots."""
    bounds = ", ".join(str(k) for k in range(n))
    return spec(robots=dice.choice((1, 64)), sensors=f"    zone: cut(speed, {bounds})\n")


def long_expression(n: int, dice: random.Random) -> str:
    """One long expression, over one line or many."""
    part = dice.choice(
        (" + speed", " and speed > 1", " if fast else speed", " < 1", "[0]", " ** 2", ".x", "\n      + 1")
    )
    return spec(reward="speed" + part * n)


def deep(n: int, dice: random.Random) -> str:
    """Deep nesting, of brackets or of blocks."""
    opening, closing = dice.choice(
        (("[", "]"), ("{a: ", "}"), ("(", ")"), ("- ", ""), ("? ", ""), ("-", ""), ("not ", ""))
    )
    return spec(more="x-deep: " + opening * n + "1" + closing * dice.choice((0, n)))


def aliases(n: int, dice: random.Random) -> str:
    """Aliases that multiply, or one that is used often."""
    times = dice.choice((1, 2, 10))
    chain = _lines(n, lambda k: f"x-a{k}: &a{k} [{', '.join([f'*a{k - 1}' if k else 'x'] * times)}]", 0)
    return spec(more=chain)


def numbers(n: int, dice: random.Random) -> str:
    """A number of many digits, as YAML's or in an expression."""
    number = dice.choice(("9", "1_", "0x", "0.", "1e", "-", "0o7")) + dice.choice("0129") * n
    return spec(constants=f"  a: {number}\n  b: one + {number}\n  c: 2 ** {number}\n")


def unicode_names(n: int, dice: random.Random) -> str:
    """Names of odd characters."""
    odd = _lines(
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
    return spec(constants=odd)


def random_data(n: int, dice: random.Random) -> str:
    """Random data of any shape."""
    return dumped(
        {
            "bbsd": 1,
            "name": "x",
            "environment": anything(dice),
            "behaviors": [anything(dice) for _ in range(min(n, 50))],
        },
        dice,
    )


def noise(n: int, dice: random.Random) -> str:
    """Random characters."""
    return "".join(
        chr(dice.choice((10, 32, dice.randrange(32, 127), dice.randrange(1, 0x3000)))) for _ in range(n)
    )


BURDENS: tuple[Burden, ...] = (
    doubling, parameters, sensors, generators, tables, unknown, keys, rules, behaviors, symbols, cells, cuts,
    long_expression, deep, aliases, numbers, unicode_names, random_data, noise,
)  # fmt: skip
SIZES = (1, 10, 40, 100, 1000, 10_000, 100_000)


def burden(dice: random.Random) -> str:
    """One of them, of some size, of 1 MB at most."""
    return dice.choice(BURDENS)(dice.choice(SIZES), dice)[:MEGABYTE]
