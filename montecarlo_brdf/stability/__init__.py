"""Which digits of a model survive in which precision.

The model's own functions, uncompiled, run on arrays of half, single, double and long double: a
kernel would promote single to double, NumPy keeps it. Truth is the next wider type everywhere and
arithmetic of 50 digits at some points, always at the rounded inputs.

Reading order: arithmetic, batch, elementary, ladder, designed, errors, climb, sampling, stress,
claims.
"""
