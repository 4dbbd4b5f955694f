"""The chi-squared distributions against scipy's, over all that counts of draws may give."""
from __future__ import annotations

import itertools

import pytest

from montecarlo_brdf import chi_squared

DOFS = (1, 2, 5, 20, 63, 400, 3000)
LEVELS = (0.1, 1e-3, 1e-6, 1e-9, 1e-12)


def test_tails_are_right_however_small() -> None:
    from scipy.special import chdtrc

    for dof, share in itertools.product(DOFS, (0.01, 0.5, 0.9, 1.0, 1.1, 1.5, 2.0, 3.0, 10.0)):
        truth = float(chdtrc(dof, share * dof))
        if truth > 1e-290:
            found = chi_squared.upper_tail(share * dof, dof)
            assert found == pytest.approx(truth, rel=1e-11), (dof, share)
    assert chi_squared.upper_tail(0.0, 3) == 1.0
    assert chi_squared.upper_tail(float("inf"), 3) == 0.0


def test_noncentrality_has_the_level_that_it_is_asked_for() -> None:
    from scipy.special import chndtrinc

    for dof, share, level in itertools.product(DOFS, (1.0, 1.1, 2.0, 5.0, 30.0), LEVELS):
        x = share * dof
        found = chi_squared.largest_excess(x, dof, level)
        assert found == pytest.approx(float(chndtrinc(x, dof, level)), rel=1e-10), (dof, share)
        assert chi_squared.noncentral(x, dof, found)[0] == pytest.approx(level, rel=1e-9)
