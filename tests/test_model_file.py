"""A user's own file: the same form as a built-in model, by path and by path:name."""
from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Outcome

import montecarlo_brdf as mb
from montecarlo_brdf.errors import ModelError

EXACT = '''\
import math
from typing import NamedTuple

class Params(NamedTuple):
    albedo: float = 0.8

def f(wo, wi, p):
    return p.albedo / math.pi

def sample(wo, u, p):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])

def pdf(wo, wi, p):
    return wi[2] / math.pi
'''

SEVERAL = '''\
import math
from typing import NamedTuple

class Params(NamedTuple):
    albedo: float = 0.8

def cosine(u):
    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]
    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0])

class matte:
    """A class with the members of a model."""
    def f(wo, wi, p):
        return p.albedo / math.pi
    def sample(wo, u, p):
        return cosine(u)
    def pdf(wo, wi, p):
        return wi[2] / math.pi

class plain:
    class Params(NamedTuple):
        c: float = 0.1
    def f(wo, wi, p):
        return p.c

def chalk(wo, wi, p):
    return 0.5 * p.albedo / math.pi
def chalk_sample(wo, u, p):
    return cosine(u)
def chalk_pdf(wo, wi, p):
    return wi[2] / math.pi
'''

Write = Callable[..., Path]
Command = Callable[..., Outcome]


def albedo(spec: object, sampler: str = "cosine", **parameters: float) -> float:
    model = mb.load(str(spec))
    e = mb.directional_albedo(model, model.parameters(**parameters), 60.0, sampler=sampler)
    return float(e.mean)


def test_the_smallest_useful_file(user_file: Write, cli: Command) -> None:
    path = user_file(EXACT)
    outcome = cli("furnace", "--model", path)
    assert outcome.code == 0 and outcome.err == ""
    assert "own" in cli("furnace", "--model", path, "--sampler", "own").out
    for sampler in ("uniform", "cosine", "own"):
        assert albedo(path, sampler, albedo=0.3) == pytest.approx(0.3, rel=1e-3)
    assert albedo(path, "own", albedo=0.3) == pytest.approx(0.3, rel=1e-15)


def test_f_alone_is_a_model(user_file: Write, cli: Command) -> None:
    path = user_file("def f(wo, wi, p):\n    return 0.25\n")
    assert albedo(path) == pytest.approx(0.25 * math.pi, rel=1e-15)
    assert cli("furnace", "--model", path, "--theta-o", 30).code == 0


def test_several_models_in_a_file(user_file: Write, cli: Command) -> None:
    path = user_file(SEVERAL)
    assert albedo(f"{path}:matte", "own", albedo=0.5) == pytest.approx(0.5, rel=1e-14)
    assert albedo(f"{path}:chalk", "own", albedo=0.5) == pytest.approx(0.25, rel=1e-14)
    assert albedo(f"{path}:plain", c=0.2) == pytest.approx(0.2 * math.pi, rel=1e-14)
    for name in ("matte", "chalk", "plain"):
        assert cli("furnace", "--model", f"{path}:{name}", "--theta-o", 30).code == 0


def test_energy_is_violated_by_a_users_file_too(user_file: Write, cli: Command) -> None:
    wrong = EXACT.replace("p.albedo / math.pi", "p.albedo")
    outcome = cli("furnace", "--model", user_file(wrong), "--theta-o", 30)
    assert outcome.code == 1 and "A / albedo" not in outcome.out
    scaled = wrong + '\n\nscales_with = "albedo"\n'
    outcome = cli("furnace", "--model", user_file(scaled), "--theta-o", 30)
    assert "A / albedo = pi: the factor 1/pi is missing" in outcome.out


def test_a_pdf_that_does_not_fit_its_sampler_is_refuted(user_file: Write, cli: Command) -> None:
    path = user_file(EXACT.replace("return wi[2] / math.pi", "return 0.5 / math.pi"))
    assert cli("furnace", "--model", path, "--theta-o", 30).code == 1


def test_a_declared_albedo_is_the_truth(user_file: Write, cli: Command) -> None:
    right = EXACT + "\ndef albedo(cos_theta_o, p):\n    return p.albedo\n"
    assert cli("furnace", "--model", user_file(right), "--theta-o", 30).code == 0
    wrong = user_file(right.replace("return p.albedo\n", "return 1.01 * p.albedo\n"))
    assert cli("furnace", "--model", wrong, "--theta-o", 30).code == 1


def test_a_sampler_may_return_its_weight_and_reject(user_file: Write) -> None:
    """Half the samples are rejected (z <= 0), so each of the rest carries twice the weight."""
    path = user_file(
        "import math\n"
        "def f(wo, wi, p):\n    return 0.5 / math.pi\n"
        "def sample(wo, u, p):\n"
        "    if u[2] < 0.5:\n        return 0.0, 0.0, -1.0, 0.0\n"
        "    r, phi = math.sqrt(u[0]), 2.0 * math.pi * u[1]\n"
        "    return r * math.cos(phi), r * math.sin(phi), math.sqrt(1.0 - u[0]), 1.0\n"
    )
    model = mb.load(str(path))
    e = mb.directional_albedo(model, model.parameters(), 60.0, sampler="own", samples=2**18)
    assert abs(e.mean - 0.5) < 7.0 * e.stderr  # t with 15 dof: beyond 7 in 4e-6 of all seeds
    assert 0.0 < e.stderr < 0.01


def test_a_jitted_helper_and_numpy_are_welcome(user_file: Write) -> None:
    path = user_file(
        "import numba\nimport numpy as np\n"
        "TABLE = np.array([0.1, 0.2])\n"
        "@numba.njit\ndef value(k):\n    return TABLE[k]\n"
        "@numba.njit\ndef f(wo, wi, p):\n    return value(1) * np.sqrt(1.0)\n"
    )
    assert albedo(path) == pytest.approx(0.2 * math.pi, rel=1e-14)


def test_choices_bind_the_option_picked(user_file: Write, cli: Command) -> None:
    path = user_file(
        "import math\nfrom typing import NamedTuple\n"
        "class Params(NamedTuple):\n    k: float = 0.5\n"
        "def once(k):\n    return k\n"
        "def twice(k):\n    return 2.0 * k\n"
        "choices = {'scale': {'once': once, 'twice': twice}}\n"
        "scale = once\n"
        "def f(wo, wi, p):\n    return scale(p.k) / math.pi\n"
    )
    model = mb.load(str(path))
    for pick, expected in (("once", 0.4), ("twice", 0.8)):
        p = model.parameters(k=0.4, scale=pick)
        assert mb.directional_albedo(model, p, 0.0).mean == pytest.approx(expected, rel=1e-14)
    outcome = cli("furnace", "--model", path, "-p", "scale=thrice")
    assert outcome.code == 2 and "choose from once, twice" in outcome.err


def test_prepare_runs_once_per_parameter_set(user_file: Write) -> None:
    path = user_file(
        "import math\nfrom typing import NamedTuple\n"
        "class Params(NamedTuple):\n    k: float = 0.5\n"
        "class Ready(NamedTuple):\n    scale: float\n    table: tuple\n"
        "def prepare(p):\n    return Ready(p.k / math.pi, (1.0, 2.0, 3.0))\n"
        "def f(wo, wi, p):\n    return p.scale * p.table[1]\n"
    )
    assert albedo(path, k=0.25) == pytest.approx(0.5, rel=1e-14)


def test_a_model_beside_its_helpers(user_file: Write) -> None:
    user_file("SCALE = 0.1\ndef shade(x):\n    return SCALE * x\n", "shading_helper.py")
    path = user_file(
        "import shading_helper\ndef f(wo, wi, p):\n    return shading_helper.shade(2.0)\n"
    )
    assert albedo(path) == pytest.approx(0.2 * math.pi, rel=1e-14)


@pytest.mark.parametrize("fixed", [[], ["-p", "k=0.3"]])
def test_lossless_with_and_without_parameters_to_vary(
    fixed: list[str], cli: Callable[..., Outcome], user_file: Callable[..., Path]
) -> None:
    path = user_file(
        "import math\nfrom typing import NamedTuple\n\n\nclass Params(NamedTuple):\n"
        "    k: float = 0.5\n\n\ndomain = {'k': (0.0, 1.0)}\nlossless = True\n\n\n"
        "def f(wo, wi, p):\n    return 1.0 / math.pi\n"
    )
    outcome = cli("run", "--model", path, "--check", "limits", *fixed)
    assert outcome.code == 0, outcome.err
    assert "PASS  4 pass" in outcome.out


REFUSED = {
    "sample = 3": "needs a function sample(wo, u, p)",
    "def pdf(wi, p):\n    return 1.0": "pdf of model {} must take the arguments (wo, wi, p)",
    "domain = {'a': (1, 0)}": "must give (low, high) for a, not (1, 0)",
    "domain = {'a': ('0', '1')}": "must give (low, high) for a",
    "domain = {'a': (0, 1)}": "domain: no parameter of model {} 'a'",
    "domain = 3": "domain of model {} must be a dictionary, not 3",
    "verified = 3": "verified of model {} must be a list of parameter sets, as Params",
    "verified = [{'b': 1}]": "verified of model {} must be a list of parameter sets",
    "verified = [5]": "verified of model {} must be a list of parameter sets",
    "same_as = 'lambrt'": "same_as of model {}: no model 'lambrt'; did you mean 'lambert'?",
    "scales_with = 'albdo'": "scales_with: no parameter of model {} 'albdo'",
    "lossless = [{'b': 1}]": "lossless of model {} must be True or a list of parameter sets",
    "limits = [({'a': 1}, 'lambert')]": "limits: no parameter of model {} 'a'",
    "limits = [({}, 'lambrt')]": "limits of model {}: no model 'lambrt'; did you mean 'lambert'?",
    "limits = [({}, 5)]": "limits of model {} must be a list of (changed parameters, model)",
    "disclaims = {'enrgy': 'x'}": "disclaims of model {} must be a dictionary from some of energy",
    "kinks = ('mu_i=mo_o',)": "kinks of model {} must be a list of some of mu_i=mu_o, cos_phi=0",
    "isotropic = 'no'": "isotropic of model {} must be True or False, not 'no'",
    "lobe = ('mirrr', f)": "one of mirror, half vector, not ('mirrr',",
    "albedo = lambda c: 0.5": "albedo of model {} must be a function (cos_theta_o, p)",
    "choices = {'norm': {'a': 5}}": "norm=a of model {} must be a function, or a dictionary",
    "choices = {'norm': {'a': {'params': {'x': 'y'}}}}": "params of norm=a of model {} must be",
    "choices = {'norm': {'a': {'functions': {'g': 5}}}}": "functions of norm=a of model {} must be",
    "same_as = 3": "same_as of model {} must be a name, not 3",
    "lossless = 3": "lossless of model {} must be True or a list of parameter sets",
    "limits = [3]": "limits of model {} must be a list of (changed parameters, model)",
    "lobe = 3": "lobe of model {} must be (kind, function of p)",
    "albedo = 0.5": "albedo of model {} must be a function (cos_theta_o, p)",
    "choices = {'norm': {}}": "needs a dictionary of options for norm",
    "choices = {'norm': {'x': {'function': f}}}": "did you mean 'functions'?",
}


@pytest.mark.parametrize("declared", REFUSED)
def test_a_member_that_cannot_mean_anything(declared: str, user_file: Write) -> None:
    path = user_file(f"def f(wo, wi, p):\n    return 0.1\n{declared}\n")
    with pytest.raises(ModelError) as refused:
        mb.load(str(path))
    assert REFUSED[declared].format(path) in str(refused.value)


PARAMETER = "from typing import NamedTuple\nclass Params(NamedTuple):\n    a: float = 0.8\n"


def test_a_default_outside_its_domain(user_file: Write) -> None:
    path = user_file(f"{PARAMETER}domain = {{'a': (0, 0.5)}}\ndef f(wo, wi, p):\n    return p.a\n")
    with pytest.raises(ModelError, match=r"a=0.8 of model .* outside its domain \[0, 0.5\]"):
        mb.load(str(path))


def test_sets_of_the_files_own_parameters(user_file: Write) -> None:
    path = user_file(f"{PARAMETER}verified = [Params(a=1.0)]\ndef f(wo, wi, p):\n    return p.a\n")
    assert mb.load(str(path)).verified[0] == (1.0,)


UNUSABLE = {
    "def prepare(p):\n    return 5": "prepare of model {} must return a NamedTuple of numbers",
    "def prepare(p):\n    return ('x',)": "NamedTuple of numbers, and of tuples and arrays of such",
    "def prepare(p):\n    raise KeyError('b')": "prepare of model {} raised KeyError (line 5): 'b'",
    "lobe = ('mirror', lambda p: 'x')": "the width of a lobe must be a number, not 'x'",
    "lobe = ('mirror', lambda p: p.width)": "lobe of model {} raised AttributeError (line 4)",
    "def albedo(c, p):\n    return 'x'": "albedo of model {} must return a number",
    "def albedo(c, p):\n    return p.x": "albedo of model {} raised AttributeError (line 5)",
}  # fmt: skip


@pytest.mark.parametrize("declared", UNUSABLE)
def test_a_member_that_gives_nothing_usable(declared: str, user_file: Write) -> None:
    path = user_file(f"import numpy as np\ndef f(wo, wi, p):\n    return 0.1\n{declared}\n")
    with pytest.raises(ModelError) as refused:
        mb.furnace(mb.load(str(path)), theta_o_deg=30.0)
    assert UNUSABLE[declared].format(path) in str(refused.value)


def test_f_that_draws_random_numbers_is_no_brdf(user_file: Write) -> None:
    path = user_file("import random\ndef f(wo, wi, p):\n    return 0.1 + 0.01 * random.random()\n")
    with pytest.raises(ModelError, match="several values for the same directions"):
        mb.run(mb.load(str(path)), names=["reciprocity"])
