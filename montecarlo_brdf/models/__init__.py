"""One BRDF per file; a user's own file has exactly the same form.

A file offers `Params`, `domain` and `f(wo, wi, p)` in 1/sr without the cosine, and mostly
`sample(wo, u, p)` with its density `pdf(wo, wi, p)`. Directions are unit vectors in the tangent
frame, n = (0, 0, 1), never below the horizon. Files with an underscore hold what models share.
"""

from pathlib import Path


def names() -> list[str]:
    """The built-in models: every file of the folder that does not start with an underscore."""
    return sorted(p.stem for p in Path(__file__).parent.glob("*.py") if not p.stem.startswith("_"))
