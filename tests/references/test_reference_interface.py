"""What references promise: names, None, laziness, and an honest quadrature of any f."""

import importlib
import math
import subprocess
import sys

import numpy as np
import pytest
import vector_models as vm
from adaptive import quadrature
from reference_data import cosine

from montecarlo_brdf import references
from montecarlo_brdf.loading import load


def test_names_are_those_of_models() -> None:
    assert {"lambert", "ggx", "cook_torrance"} <= set(references.names())
    assert not any(name.startswith("_") for name in references.names())
    assert references.find("no_such_model") is None
    assert references.find("_rules") is None


@pytest.mark.parametrize("name", references.names())
def test_every_reference_keeps_the_interface(name: str) -> None:
    reference = references.find(name)
    assert reference is not None
    assert callable(reference.albedo)
    assert callable(reference.bihemispherical)
    reverse = getattr(reference, "reverse_albedo", None)
    assert (reverse is not None) == ("reciprocity" in load(name).disclaims)
    module = importlib.import_module(f"{references.__name__}.{references.FILES.get(name, name)}")
    assert name in str(module.__doc__) or name not in references.FILES
    assert module.__doc__


def test_unknown_models_have_no_truth() -> None:
    assert references.albedo("no_such_model", 0.5) is None
    assert references.reverse_albedo("no_such_model", 0.5) is None
    assert references.bihemispherical("no_such_model") is None


def test_reciprocal_models_send_back_what_they_send_out() -> None:
    out = references.albedo("ggx", 0.3, alpha=0.2, f0=0.5)
    assert references.reverse_albedo("ggx", 0.3, alpha=0.2, f0=0.5) == out


def test_closed_forms_import_no_numpy() -> None:
    code = (
        "import sys; before = set(sys.modules)\n"
        "from montecarlo_brdf import references as r\n"
        "had = {'numpy', 'scipy'} & set(sys.modules)\n"
        "r.albedo('lambert', 0.5, albedo=0.5); r.albedo('eon', 0.5, albedo=0.5, roughness=1.0)\n"
        "assert {'numpy', 'scipy'} & set(sys.modules) == had, 'imported by a closed form'\n"
        "import montecarlo_brdf.references._quadrature\n"
        "assert 'scipy.special' not in sys.modules or 'scipy' in had\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("alpha", [0.02, 0.3, 1.0])
def test_energy_is_conserved_where_it_must_be(alpha: float) -> None:
    """GGX loses, its compensations lose nothing, and alpha = 1 is Lommel-Seeliger."""
    for theta in (0.0, 50.0, 89.99):
        mu = cosine(theta)
        single = references.albedo("ggx", mu, alpha=alpha, f0=1.0)
        assert single is not None and single.value < 1.0
        for name in ("ggx_kulla_conty", "ggx_turquin"):
            white = references.albedo(name, mu, alpha=alpha, f0=1.0)
            near = references.albedo(name, mu, alpha=alpha, f0=1.0 - 2.0**-40)
            assert white is not None and near is not None
            assert white.value == 1.0
            assert abs(near.value - 1.0) < 1e-11
        if alpha == 1.0:
            exact = references.albedo("lommel_seeliger", mu, albedo=1.0)
            assert exact is not None
            assert abs(single.value - exact.value) <= single.error + exact.error


@pytest.mark.parametrize("theta", [0.0, 40.0, 85.0])
def test_same_widths_are_isotropic(theta: float) -> None:
    one = references.albedo("ggx", cosine(theta), alpha=0.3, f0=0.2)
    two = references.albedo(
        "ggx_anisotropic", cosine(theta), alpha_x=0.3, alpha_y=0.3, f0=0.2, phi_o=0.4
    )
    assert one is not None and two is not None
    assert abs(one.value - two.value) <= one.error + two.error


@pytest.mark.parametrize("theta", [0.0, 60.0, 89.0])
@pytest.mark.parametrize("alpha", [0.1, 0.01, 0.001])
def test_no_lobe_is_missed(alpha: float, theta: float) -> None:
    wo = vm.view(cosine(theta), 2.0)
    found = quadrature(
        lambda wi: vm.microfacet(wi, wo, beckmann=False, mask="smith", alpha=alpha, f0=1.0), wo
    )
    truth = references.albedo("ggx", wo[2], alpha=alpha, f0=1.0)
    assert truth is not None
    assert abs(found.value - truth.value) <= found.error + truth.error
    assert found.error < 1e-8


def test_retro_reflection_is_found() -> None:
    """A lobe of 0.002 rad back to the view; exp(k (w.v - 1)) integrates to 2 pi/k."""
    wo, k = vm.view(cosine(50.0), -1.0), 0.5e6
    found = quadrature(
        lambda wi: k / (2.0 * math.pi) * np.exp(k * (np.array(wo) @ wi - 1.0)), wo, cosine=False
    )
    assert abs(found.value - 1.0) <= found.error
    assert found.error < 1e-8


def test_a_stated_peak_is_found() -> None:
    axis, wo, k = np.array(vm.view(0.31, 0.77)), vm.view(0.9), 1e7
    lobe = quadrature(
        lambda wi: k / (2.0 * math.pi) * np.exp(k * (axis @ wi - 1.0)),
        wo,
        cosine=False,
        peaks=[axis],
    )
    assert abs(lobe.value - 1.0) <= lobe.error < 1e-7


def test_unresolved_is_said() -> None:
    wo = vm.view(0.6)
    jump = quadrature(lambda wi: (wi[0] + 0.3 * wi[1] > 0.2).astype(float), wo, budget=400_000)
    assert jump.source.startswith("not resolved")
    assert jump.error > 1e-8
    infinite = quadrature(lambda wi: np.full_like(wi[2], np.inf), wo)
    assert infinite.error == math.inf
    assert infinite.source.startswith("not resolved")


@pytest.mark.parametrize("mu", [0.0, -0.1, 1.1, math.nan])
def test_a_quadrature_refuses_what_is_no_cosine(mu: float) -> None:
    for name in ("ggx", "beckmann"):
        with pytest.raises(ValueError, match="cos_theta"):
            references.albedo(name, mu, alpha=0.3, f0=0.5)
