"""Parameter sets that a description names: `alpha = 0.3, base = 1; alpha = 1`."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from montecarlo_brdf.errors import unknown
from montecarlo_brdf.foreign.complaint import Complaint

#: a set in which nothing is changed
DEFAULTS = "defaults"


def changes(text: str, known: Mapping[str, Collection[str]]) -> dict[str, float]:
    """The fields that one set changes. known: what each name sets, a colour all its channels.

    Raises Complaint for what is no assignment, or of no parameter.
    """
    found: dict[str, float] = {}
    for part in text.split(",") if text.strip() != DEFAULTS else ():
        name, _, value = (x.strip() for x in part.partition("="))
        if name not in known:
            raise Complaint(unknown("parameter", name, sorted(known)))
        try:
            found |= dict.fromkeys(known[name], float(value))
        except ValueError:
            raise Complaint(f"write `{name} = number`, not {part.strip()!r}") from None
    return found


def every(text: str, known: Mapping[str, Collection[str]]) -> Iterator[dict[str, float]]:
    """All sets of a text."""
    for one in text.split(";"):
        if one.strip():
            yield changes(one, known)


def limits(text: str, known: Mapping[str, Collection[str]]) -> list[tuple[dict[str, float], str]]:
    """Changed parameters, and the model that they make: `alpha = 1: lambert`."""
    found = []
    for one in (part for part in text.split(";") if part.strip()):
        changed, colon, model = one.rpartition(":")
        if not colon or not model.strip():
            raise Complaint(f"write `parameter = number: model`, not {one.strip()!r}")
        found.append((changes(changed, known), model.strip()))
    return found
