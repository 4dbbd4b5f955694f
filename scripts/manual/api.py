"""The functions and classes that a program imports, as autodoc reads them."""

from __future__ import annotations

import inspect
from collections.abc import Iterable

import montecarlo_brdf
from montecarlo_brdf import testing

#: what a program gets from the functions
RETURNED = ("judge.finding.Report", "judge.finding.Result", "judge.finding.Finding",
            "judge.finding.Verdict", "scene.scene.Scene", "scene.render.Sphere")  # fmt: skip
#: what it may hand to them
TAKEN = ("estimate.plan.Plan", "verify.supervision.Deadline", "testing.Options", "testing.Terms")


def made() -> str:
    """A section for the package, what it returns, and the assertions."""
    ours = [n for n in montecarlo_brdf.__all__ if not n.startswith("_")]
    classes = [n for n in ours if inspect.isclass(getattr(montecarlo_brdf, n))]
    functions = [n for n in ours if n not in classes]
    parts = {
        "Functions": _listed("function", functions),
        "Classes": _listed("class", classes),
        "What the functions return": _listed("class", RETURNED),
        "What they may be given": _listed("class", TAKEN),
        "Assertions for a test suite": _listed(
            "function", [f"testing.{name}" for name in testing.__all__]
        ),
    }
    return "\n".join(f"## {title}\n\n```{{eval-rst}}\n{rst}\n```\n" for title, rst in parts.items())


def _listed(kind: str, names: Iterable[str]) -> str:
    members = "\n   :members:" if kind == "class" else ""
    return "\n\n".join(f".. auto{kind}:: montecarlo_brdf.{name}{members}" for name in names)
