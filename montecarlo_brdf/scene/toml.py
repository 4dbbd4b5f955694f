"""Reading TOML with complaints that name the file, the line and what is allowed."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from montecarlo_brdf.errors import UserError, unknown
from montecarlo_brdf.scene.lines import Path_, line_of
from montecarlo_brdf.vectors import Vec, from_degrees

REQUIRED: Any = object()


def parse(path: Path) -> tuple[dict[str, Any], str]:
    """The data and the text of a TOML file."""
    try:
        text = path.read_text(encoding="utf-8")
        return tomllib.loads(text), text
    except OSError as error:
        raise UserError(f"cannot read {path}: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise UserError(f"{path} is not a TOML file: it is not text") from error
    except tomllib.TOMLDecodeError as error:
        raise UserError(f"{path} is not a TOML file: {error}") from error
    except RecursionError as error:
        raise UserError(f"{path} is nested too deeply") from error


class Table:
    """One table of the file; every key must be taken, or `done` complains about it."""

    def __init__(self, file: Path, text: str, data: Mapping[str, Any], path: Path_ = ()) -> None:
        self.file, self.text, self.data, self.path = file, text, data, path
        self._known: dict[str, None] = {}
        self.wavelengths: tuple[float, ...] | None = None

    def error(self, sentence: str, key: str | None = None) -> UserError:
        """A UserError that begins with the place."""
        line = line_of(self.text, (*self.path, key) if key else self.path)
        return UserError(f"{self.file}{f', line {line}' if line else ''}: {sentence}")

    def take(self, key: str, default: Any = REQUIRED) -> Any:
        """The raw value of a key."""
        self._known[key] = None
        if key in self.data:
            return self.data[key]
        if default is REQUIRED:
            raise self.error(f"{self.title()} needs {key!r}")
        return default

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

    def number(
        self, key: str, default: Any = REQUIRED, low: float = -math.inf, high: float = math.inf
    ) -> float:
        """A finite number between low and high."""
        value = self.take(key, default)
        if not (_is_number(value) and low <= value <= high):
            raise self.error(f"{key} must be {_range(low, high)}, not {_shown(value)}", key)
        return float(value)

    def text_of(self, key: str, default: Any = REQUIRED) -> str:
        """A string."""
        value = self.take(key, default)
        if not isinstance(value, str):
            raise self.error(f"{key} must be text in quotes, not {_shown(value)}", key)
        return value

    def flag(self, key: str, default: bool = False) -> bool:
        """true or false."""
        value = self.take(key, default)
        if not isinstance(value, bool):
            raise self.error(f"{key} must be true or false, not {_shown(value)}", key)
        return value

    def choice(self, key: str, allowed: Iterable[str], default: Any = REQUIRED) -> str:
        """One of some words."""
        names = list(allowed)
        value = self.take(key, default)
        if value not in names:
            raise self.error(unknown(key, value, names), key)
        return str(value)

    def numbers(
        self, key: str, count: int | None = None, default: Any = REQUIRED
    ) -> tuple[float, ...]:
        """A list of finite numbers; one number counts as a list of one."""
        value = self.take(key, default)
        row = value if isinstance(value, (list, tuple)) else [value]
        if not row or not all(map(_is_number, row)) or (count and len(row) != count):
            wanted = f"a list of {count} numbers" if count else "a number or a list of numbers"
            raise self.error(f"{key} must be {wanted}, not {_shown(value)}", key)
        return tuple(float(v) for v in row)

    def direction(self, key: str, default: Any = REQUIRED) -> Vec:
        """A unit vector from [x, y, z], or from {tilt_deg, azimuth_deg}."""
        value = self.take(key, default)
        if isinstance(value, dict):
            table = self.table(key)
            found = from_degrees(
                table.number("tilt_deg", 0.0, 0.0, 180.0), table.number("azimuth_deg", 0.0)
            )
            table.done()
            return found
        x, y, z = self.numbers(key, 3, default)
        size = math.hypot(x, y, z)
        if size == 0.0:
            raise self.error(f"{key} has no direction: all three numbers are 0", key)
        return x / size, y / size, z / size

    def colour(
        self, key: str, default: Any = REQUIRED, low: float = 0.0
    ) -> float | tuple[float, ...]:
        """A number, one per channel, or (wavelength, value) pairs at the scene's wavelengths."""
        value = self.take(key, default)
        if isinstance(value, (list, tuple)) and value and isinstance(value[0], (list, tuple)):
            found: Any = self._spectrum(key, value)
        elif isinstance(value, (list, tuple)):
            found = self.numbers(key, None, default)
        else:
            found = self.number(key, default)
        row = found if isinstance(found, tuple) else (found,)
        if min(row) < low:
            raise self.error(f"{key} must be at least {low:g}, not {min(row):g}", key)
        return found

    def _spectrum(self, key: str, value: Any) -> tuple[float, ...]:
        from montecarlo_brdf.scene.spectrum import interpolated, pairs

        if self.wavelengths is None:
            raise self.error(f"{key} is a spectrum: the scene needs [spectrum] wavelengths", key)
        try:
            return interpolated(pairs(value), self.wavelengths)
        except UserError as error:
            raise self.error(f"{key}: {error}", key) from None

    def table(self, key: str, default: Any = REQUIRED) -> Table:
        """A table below this one."""
        value = self.take(key, default)
        if not isinstance(value, dict):
            raise self.error(f"{key} must be a table, not {_shown(value)}", key)
        return self._below(value, (*self.path, key))

    def tables(self, key: str) -> list[Table]:
        """An array of tables below this one."""
        value = self.take(key, [])
        if not isinstance(value, list) or not all(isinstance(v, dict) for v in value):
            raise self.error(f"{key} must be [[{key}]] tables, not {_shown(value)}", key)
        return [self._below(v, (*self.path, key, k)) for k, v in enumerate(value)]

    def _below(self, data: Mapping[str, Any], path: Path_) -> Table:
        table = Table(self.file, self.text, data, path)
        table.wavelengths = self.wavelengths
        return table


def _is_number(value: Any) -> bool:
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


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
