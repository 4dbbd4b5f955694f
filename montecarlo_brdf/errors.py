"""What goes wrong, as one clear sentence with an exit code. A crash must not look like a
verdict."""

from __future__ import annotations

from collections.abc import Iterable


class UserError(Exception):
    """A mistake in what was asked for: unknown name, bad value, missing file.

    about: the name whose value is wrong, where the mistake is in one.
    """

    exit_code = 2

    def __init__(self, sentence: str = "", about: str | None = None) -> None:
        super().__init__(sentence)
        self.about = about


class ModelError(UserError):
    """The model could not be loaded or compiled, or it raised."""

    exit_code = 4


class Raised(ModelError):
    """Machine code met an exception of the model's, and does not tell which or where."""


class TooSlow(UserError):
    """The model did not return in time, so nothing is known about it."""

    exit_code = 3


class OutputError(UserError):
    """A result could not be written."""

    exit_code = 5


def unknown(kind: str, name: object, allowed: Iterable[str]) -> str:
    """Sentence for a name that is not among `allowed`, with the nearest one if there is any."""
    names = [str(name) for name in allowed]  # enums by their values
    import difflib  # slow to import, and seldom needed

    near = difflib.get_close_matches(str(name), names, n=1)
    guess = f"; did you mean {near[0]!r}?" if near else ""
    return f"no {kind} {str(name)!r}{guess} (choose from {', '.join(names) or 'none'})"
