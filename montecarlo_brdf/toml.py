"""Reading TOML with complaints that name the file, the line and what is allowed."""

from __future__ import annotations

import contextlib
import difflib
import itertools
import math
import re
import tomllib
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any, Self, TypeGuard

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.files import know_input

Keys = tuple[str | int, ...]  # from the top of the file down; numbers count [[tables]]

REQUIRED = object()
HEADER = re.compile(r"^\s*(\[\[?)\s*([\w.\-\"' ]+?)\s*\]\]?\s*(#.*)?$")
KEY = re.compile(r"^\s*([\w.\-\"']+)\s*=")


class FileError(UserError):
    """A mistake in a file; its sentence begins with the file and the line."""


def parse(path: Path) -> tuple[dict[str, Any], str]:
    """The data and the text of a TOML file."""
    know_input(path)
    try:
        text = path.read_text(encoding="utf-8-sig")  # a byte order mark says nothing here
        return tomllib.loads(text), text
    except OSError as error:
        raise UserError(f"cannot read {path}: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise UserError(f"{path} is not a TOML file: it is not text") from error
    except ValueError as error:  # TOMLDecodeError, or a whole number of too many digits
        raise UserError(f"{path} is not a TOML file: {error}") from error
    except RecursionError as error:
        raise UserError(f"{path} is nested too deeply") from error


class Table:
    """One table of the file; every key must be taken, or `done` complains about it."""

    def __init__(self, file: Path, text: str, data: Mapping[str, Any], path: Keys = ()) -> None:
        self.file, self.text, self.data, self.path = file, text, data, path
        self._known: dict[str, None] = {}

    def error(self, sentence: str, key: str | None = None) -> FileError:
        """An error that begins with the place."""
        line = line_of(self.text, (*self.path, key) if key else self.path)
        return FileError(f"{self.file}{f', line {line}' if line else ''}: {sentence}")

    @contextlib.contextmanager
    def at(self, key: str) -> Iterator[None]:
        """Mistakes in a block are those of `key`, or of the one that they are about."""
        try:
            yield
        except FileError:
            raise
        except UserError as error:
            about = error.about if error.about in self.data else key
            raise self.error(str(error), about) from error

    def take(self, key: str, default: object = REQUIRED) -> Any:
        """The raw value of a key."""
        self._known[key] = None
        if key in self.data:
            return self.data[key]
        if default is REQUIRED:
            self._complain_of_misspelling(key)
            raise self.error(f"{self.title()} needs {key!r}")
        return default

    def _complain_of_misspelling(self, key: str) -> None:
        """The key that stands in place of a missing one is what to look at."""
        others = [name for name in self.data if name not in self._known]
        for near in difflib.get_close_matches(key, others, n=1):
            raise self.error(unknown(f"key of {self.title()}", near, [key]), near)

    def know(self, *keys: str) -> None:
        """Keys that may stand here."""
        self._known |= dict.fromkeys(keys)

    def title(self) -> str:
        """'[surface]', '[[lights]] 2', 'the scene'."""
        if not self.path:
            return "the scene"
        if isinstance(self.path[-1], int):
            return f"[[{'.'.join(map(str, self.path[:-1]))}]] {self.path[-1] + 1}"
        return f"[{'.'.join(map(str, self.path))}]"

    def done(self) -> None:
        """Complain about a key that nobody took."""
        for key in self.data:
            if key not in self._known:
                raise self.error(unknown(f"key of {self.title()}", key, self._known), key)

    def _held(self, key: str, value: object, holds: bool, wanted: str) -> Any:
        """The value of a key that holds, or a complaint about what is wanted."""
        if not holds:
            raise self.error(f"{key} must be {wanted}, not {_shown(value)}", key)
        return value

    def number(
        self, key: str, default: object = REQUIRED, low: float = -math.inf, high: float = math.inf
    ) -> float:
        """A finite number between low and high."""
        value = self.take(key, default)
        inside = is_number(value) and low <= value <= high
        return float(self._held(key, value, inside, _range(low, high)))

    def text_of(self, key: str, default: object = REQUIRED) -> str:
        """A string."""
        value = self.take(key, default)
        return str(self._held(key, value, isinstance(value, str), "text in quotes"))

    def flag(self, key: str, default: bool = False) -> bool:
        """true or false."""
        value = self.take(key, default)
        return bool(self._held(key, value, isinstance(value, bool), "true or false"))

    def choice(self, key: str, allowed: Collection[str], default: object = REQUIRED) -> str:
        """One of some words."""
        value = self.take(key, default)
        if value not in list(allowed):  # a list: the value may be one that no set takes
            raise self.error(unknown(key, value, allowed), key)
        return str(value)

    def numbers(
        self, key: str, count: int | None = None, default: object = REQUIRED
    ) -> tuple[float, ...]:
        """A list of finite numbers; one number counts as a list of one."""
        value = self.take(key, default)
        row = value if isinstance(value, (list, tuple)) else [value]
        holds = bool(row) and all(map(is_number, row)) and len(row) == (count or len(row))
        wanted = f"a list of {count} numbers" if count else "a number or a list of numbers"
        self._held(key, value, holds, wanted)
        return tuple(float(v) for v in row)

    def table(self, key: str, default: object = REQUIRED) -> Self:
        """A table below this one."""
        value = self.take(key, default)
        return self.below(self._held(key, value, isinstance(value, dict), "a table"), key)

    def tables(self, key: str) -> list[Self]:
        """An array of tables below this one."""
        value = self.take(key, [])
        holds = isinstance(value, list) and all(isinstance(v, dict) for v in value)
        self._held(key, value, holds, f"[[{key}]] tables")
        return [self.below(v, key, k) for k, v in enumerate(value)]

    def below(self, data: Mapping[str, Any], *keys: str | int) -> Self:
        """A table of the same kind that stands under `keys` of this one."""
        return type(self)(self.file, self.text, data, (*self.path, *keys))


def is_number(value: object) -> TypeGuard[float]:
    """Whether it is a finite number, and not true or false."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:
        return False


def _range(low: float, high: float) -> str:
    if math.isinf(low) and math.isinf(high):
        return "a finite number"
    if math.isinf(high):
        return f"a number of at least {low:g}"
    return f"a number in [{low:g}, {high:g}]"


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def line_of(text: str, path: Keys) -> int | None:
    """The line of a key or table, which tomllib does not tell.

    It is that of the longest part of `path` that stands in the text.
    """
    best, at = 0, None
    here: Keys = ()
    counts: dict[str, int] = {}
    for number, line in enumerate(text.splitlines(), start=1):
        if header := HEADER.match(line):
            name = header.group(2)
            here = _names(name)
            if header.group(1) == "[[":
                counts[name] = counts.get(name, -1) + 1
                here = (*here, counts[name])
            found = here
        elif key := KEY.match(line):
            found = (*here, *_names(key.group(1)))
        else:
            continue
        shared = _shared(_flat(found, counts), path)
        if shared > best and shared in (len(found), len(path)):
            best, at = shared, number
    return at


def _names(dotted: str) -> tuple[str, ...]:
    return tuple(part.strip(" \"'") for part in dotted.split("."))


def _flat(found: Keys, counts: Mapping[str, int]) -> Keys:
    """A table below an array of tables belongs to its latest element."""
    name = str(found[0])
    if name in counts and (len(found) < 2 or not isinstance(found[1], int)):
        return (name, counts[name], *found[1:])
    return found


def _shared(a: Keys, b: Keys) -> int:
    """How many keys are the same from the top."""
    same = (x == y for x, y in zip(a, b, strict=False))
    return sum(1 for _ in itertools.takewhile(bool, same))
