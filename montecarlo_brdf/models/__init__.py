"""One BRDF per file; a user's own file has exactly the same form.

A file offers `Params`, `domain` and `f(wo, wi, p)` in 1/sr without the cosine, and mostly
`sample(wo, u, p)` with its density `pdf(wo, wi, p)`. Directions are unit vectors in the tangent
frame, n = (0, 0, 1), never below the horizon. Files with an underscore hold what models share.
"""
