"""`python -m fuzzing.folders`: odd run folders and odd `--set` arguments, against the commands that read them.

Nothing but diagnoses may come out: no traceback, no command that hangs, no file changed outside of the folder.
Stops with exit code 1 at the first folder that breaks a rule, and keeps it.
"""

from __future__ import annotations

import argparse
import json
import random
import resource
import shutil
import sys
import tempfile
import time
from collections import Counter
from copy import deepcopy
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fuzzing.damage import EXPRESSIONS, NAMES, NUMBERS, SIGNS, damaged, random_data
from fuzzing.faults.commands import METHODS, Running, command, design, prepare

if TYPE_CHECKING:
    from collections.abc import Callable

HANGS = 60.0
"""Seconds of the processor after which the system ends a command."""
WATCHED = 3.0
"""Seconds after which `watch`, which waits for another process, is ended."""
MEMORY = 4 << 30
"""Bytes of address space that a command may take beyond what this process has."""
RECORDS = ("run.json", "metrics.jsonl", "visits.json", "lock")
FILES = (
    *RECORDS,
    "spec.yaml",
    "architecture.yaml",
    "checkpoint.npz",
    "checkpoint.previous.npz",
    "champions.csv",
)
CODES = (0, 1, 2)
SMALL = 200
"""Steps and episodes of commands that run some."""
COMMANDS: tuple[Callable[[Path], list[str | Path]], ...] = (
    lambda out: ["watch", out],
    lambda out: ["runs", out],
    lambda out: ["report", out, "-o", out / "page.html", "--episodes", "2"],
    lambda out: ["explain", out],
    lambda out: ["evaluate", out, "--episodes", str(SMALL)],
    lambda out: ["design", out, "--resume", "-q"],
    lambda out: ["design", out / "spec.yaml", "--seed", "1", "--out", out, "--resume", "-q"],
    lambda out: [
        "design",
        out / "spec.yaml",
        "--seed",
        "1",
        "--out",
        out,
        "-q",
        "--set",
        "design.budget=5000",
    ],
    lambda out: ["compare", out, out / "spec.yaml"],
    lambda out: ["tidy", out],
)


def odd_value(dice: random.Random) -> Any:  # noqa: ANN401 - any plain value
    """Return a value that a record hardly ever has."""
    return dice.choice(
        (
            None,
            True,
            [],
            {},
            dice.choice(NUMBERS),
            dice.choice(NAMES),
            random_data(dice),
            10**400,
            -5,
            1e300,
            "1",
        )
    )


def places(value: Any) -> list[tuple[Any, Any]]:  # noqa: ANN401 - any plain value
    """Return all containers in a value, each with a key or an index of it."""
    keys = list(value) if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ()
    return [place for key in keys for place in ((value, key), *places(value[key]))]


def odd_record(content: bytes, dice: random.Random) -> bytes:
    """Change the data of a record, line by line where it has several, in a few places."""
    lines = (
        content.decode(errors="replace").split("\n")
        if content.count(b"}\n") > 1
        else [content.decode(errors="replace")]
    )
    index = dice.randrange(len(lines))
    try:
        value = json.loads(lines[index])
    except (ValueError, RecursionError):
        return content + b"[" * dice.choice((1, 100_000))
    for _ in range(dice.randint(1, 3)):
        where = places(value)
        if not where or dice.random() < 0.05:
            value = odd_value(dice)
            continue
        within, key = dice.choice(where)
        match dice.randrange(4):
            case 0 if isinstance(within, dict):
                del within[key]
            case 1 if isinstance(within, dict):
                within[dice.choice(NAMES)] = deepcopy(within[key])
            case _:
                within[key] = odd_value(dice)
    lines[index] = json.dumps(value, ensure_ascii=dice.random() < 0.5)
    return "\n".join(lines).encode(errors="surrogatepass")


def odd_bytes(content: bytes, dice: random.Random) -> bytes:
    """Cut, empty, flip, lengthen or replace a file's content."""
    index = dice.randrange(len(content) + 1)
    return dice.choice(
        (
            b"", content[:index], content[:index] + bytes([dice.randrange(256)]) + content[index + 1 :],
            content + content[:index], bytes(dice.randrange(256) for _ in range(100)), b"[" * 100_000,
            b"\xff\xfe" + content,
        )
    )  # fmt: skip


def change_file(out: Path, victim: Path, dice: random.Random) -> str:
    """Change a file of a run's folder, and return what was done."""
    name = dice.choice((*FILES, *RECORDS, *RECORDS))
    path = out / dice.choice(("", "", "run-1", "run-2")) / name
    if not path.parent.is_dir():
        path = out / name
    content = path.read_bytes() if path.is_file() else b""
    kind = dice.choice(
        ("record", "record", "record", "bytes", "bytes", "text", "gone", "folder", "link", "link out")
    )
    if kind == "record" and name in RECORDS:
        _put(path, odd_record(content, dice))
    elif kind == "text" and name.endswith(".yaml"):
        _put(path, damaged(content.decode(errors="replace"), dice).encode(errors="surrogatepass"))
    elif kind in ("gone", "folder", "link", "link out"):
        _remove(path)
        if kind == "folder":
            path.mkdir()
        elif kind == "link":
            path.symlink_to(dice.choice((name, "run.json", "nowhere", "..")))
        elif kind == "link out":
            path.symlink_to(dice.choice((victim, victim.parent, "/dev/null")))
    else:
        kind = "bytes"
        _put(path, odd_bytes(content, dice))
    return f"{kind} {path.relative_to(out)}"


def _put(path: Path, content: bytes) -> None:
    _remove(path)
    path.write_bytes(content)


def _remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


def odd_setting(keys: list[str], dice: random.Random) -> str:
    """Return an argument of `--set`."""
    key = dice.choice(
        (
            dice.choice(keys),
            dice.choice(keys),
            dice.choice(NAMES),
            f"{dice.choice(keys)}.{dice.choice(NAMES)}",
        )
    )
    value = dice.choice(
        (*map(str, NUMBERS), *NAMES, *EXPRESSIONS, *SIGNS, "[1, 2]", "{a: 1}", "a\nb: 1", "", "010", "-0.0")
    )
    text = dice.choice(
        (f"{key}={value}", f"{key}={value}", f"{key} = {value}", key, f"{key}:{value}", f"={value}")
    )
    return text.replace("\0", "")


def keys_of(value: Any, prefix: str = "") -> list[str]:  # noqa: ANN401 - any plain value
    """Return the keys of a spec as `--set` names them."""
    if not isinstance(value, dict):
        return []
    own = [f"{prefix}{key}" for key in value]
    return [*own, *(key for name, inner in value.items() for key in keys_of(inner, f"{prefix}{name}."))]


def limited() -> None:
    """Let the system end a command that hangs or takes too much memory."""
    resource.setrlimit(resource.RLIMIT_CPU, (int(HANGS), int(HANGS)))
    used = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, used + MEMORY))


def outcome(words: list[str | Path]) -> str:
    """Run a command and return which rule it broke, empty where it broke none."""
    running = Running(words, limited)
    if words[0] == "watch":
        end, is_over = time.monotonic() + WATCHED, False
        while time.monotonic() < end and not (is_over := running.is_over()):
            time.sleep(0.02)
        if not is_over:
            running.kill()
            ended = running.ended()
            return f"{ended}" if "Traceback" in ended.err else ""
    ended = running.ended()
    if ended.code not in CODES or "Traceback" in ended.err or "MemoryError" in ended.err:
        return str(ended)
    return "exit code 2 without a word" if ended.code == 2 and not ended.err.strip() else ""


def main() -> int:
    """Try folders and settings until the time is over or one of them breaks a rule; return 1 if one does."""
    import yaml

    parser = argparse.ArgumentParser(prog="python -m fuzzing.folders", description=__doc__)
    parser.add_argument("--seconds", type=float, default=60, help="for how long (default: 60)")
    parser.add_argument("--seed", type=int, default=0, help="which folders are tried (default: 0)")
    parser.add_argument("--go-on", action="store_true", help="do not stop at what breaks a rule")
    options = parser.parse_args()
    dice, place = random.Random(options.seed), Path(tempfile.mkdtemp(prefix="bbsd-folders-"))
    spec = prepare(place)
    originals = []
    for name, more in {"one": ("--runs", "1"), "two": ()}.items():
        for method, settings in METHODS.items():
            originals.append(place / f"{method}-{name}")
            if (ended := command(*design(spec, originals[-1], settings, *more))).code:
                raise RuntimeError(str(ended))
    keys = keys_of(yaml.safe_load(spec.read_text(encoding="utf-8")))
    outside, out, tried, wrong = place / "outside", place / "out", Counter[str](), 0
    began = time.monotonic()
    while time.monotonic() - began < options.seconds:
        for path in (outside, out):
            _remove(path)
        outside.mkdir()
        victim = outside / "victim"
        victim.write_bytes(b"precious\n")
        if dice.random() < 0.25:
            words: list[str | Path] = ["check", spec]
            done = [odd_setting(keys, dice) for _ in range(dice.randint(1, 3))]
            words += [word for setting in done for word in ("--set", setting)]
        else:
            shutil.copytree(dice.choice(originals), out)
            done = [change_file(out, victim, dice) for _ in range(dice.randint(1, 3))]
            words = dice.choice(COMMANDS)(out)
        tried[str(words[0])] += 1
        told = outcome(words)
        if victim.read_bytes() != b"precious\n" or [*outside.iterdir()] != [victim]:
            told += " a file outside was changed"
        if told:
            wrong += 1
            print(f"{sum(tried.values())}: {words} after {done}: {told}\n", flush=True)
            if not options.go_on:
                print(f"kept in {place}")
                return 1
    shutil.rmtree(place)
    counts = ", ".join(f"{count} {name}" for name, count in sorted(tried.items()))
    print(
        f"{sum(tried.values())} in {time.monotonic() - began:.0f} s with seed {options.seed} ({counts}): {wrong} wrong"
    )
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
