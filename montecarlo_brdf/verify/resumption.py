"""A run that may be interrupted and taken up again: its partial sums in a file."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Iterator
from pathlib import Path

from montecarlo_brdf.errors import UserError
from montecarlo_brdf.estimate.partial_sums import PartialSums
from montecarlo_brdf.files import check_writable, write_text


@contextlib.contextmanager
def partial_sums(path: str | Path | None) -> Iterator[PartialSums | None]:
    """The partial sums in the file `path`, written there from time to time and at the end.

    Written whole or not at all, also when the run ends by an error or Ctrl-C; None for no path.
    Raises UserError if there is a file that holds anything else, OutputError if it cannot be
    written.
    """
    if path is None:
        yield None
        return
    path = Path(path)
    check_writable(path)
    sums = _read(path)
    try:
        yield sums
    finally:
        sums.write()


def _read(path: Path) -> PartialSums:
    save = functools.partial(write_text, path)
    if not path.exists():
        return PartialSums(save)
    try:
        return PartialSums(save, path.read_text(encoding="utf-8"))
    except OSError as error:
        raise UserError(f"cannot read {path}: {error.strerror or error}") from error
    except (UnicodeDecodeError, UserError) as error:
        raise UserError(f"cannot resume from {path}: {error}") from error
