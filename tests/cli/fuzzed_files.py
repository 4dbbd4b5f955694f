"""Files to throw at the program: models, scenes, settings, reports, made of what they hold."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hypothesis import strategies as st

ROOT = Path(__file__).parents[2]

LINES = [
    "import math",
    "def f(wo, wi, p):",
    "    return 0.3",
    "def sample(wo, u, p):",
    "    return u",
    "def pdf(wo, wi, p):",
    "class Params:",
    "    albedo = 1",
    "domain = 3",
    "domain = {'a': 1}",
    "choices = {'n': {}}",
    "choices = 7",
    "choices = {'n': {'a': 1}}",
    "verified = 5",
    "f = 3",
    "raise",
    "raise SystemExit",
    "1/0",
    "disclaims = []",
    "lobe = 1",
    "def f(a):",
    "prepare = f",
    "\tx",
    "'''",
    "kinks = 3",
    "from nowhere import f",
    "isotropic = 'no'",
    "lossless = 'x'",
    "scales_with = 4",
]


def model_files() -> st.SearchStrategy[bytes]:
    """Files made of lines that model files are made of, or of anything."""
    lines = st.lists(st.sampled_from(LINES), max_size=8).map("\n".join)
    whole = lines.map(lambda t: f"def f(wo, wi, p):\n    return 0.3\n{t}\n")
    return st.one_of(whole.map(str.encode), lines.map(str.encode), st.binary(max_size=60))


def reports() -> st.SearchStrategy[Any]:
    """JSON that looks like a report, with anything in any place."""
    leaf = st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=4)
    anything = st.recursive(
        leaf,
        lambda s: (
            st.lists(s, max_size=3)
            | st.dictionaries(
                st.sampled_from(["where", "value", "quantity", "theta_o_deg", "x"]), s, max_size=3
            )
        ),
        max_leaves=6,
    )
    finding = st.fixed_dictionaries(
        {
            "quantity": st.just("A") | anything,
            "where": st.just({"theta_o_deg": 30.0}) | anything,
            "verdict": st.just("pass") | anything,
        },
        optional={
            "value": anything,
            "stderr": anything,
            "expected": anything,
            "tolerance": anything,
        },
    )
    result = st.fixed_dictionaries(
        {
            "model": st.just("x") | anything,
            "params": st.just({}) | anything,
            "findings": st.lists(finding, max_size=3) | anything,
        },
        optional={"curves": anything, "check": anything},
    )
    command = st.sampled_from(["furnace", "stress", "run", None])
    report = st.fixed_dictionaries(
        {
            "schema": st.just(1),
            "command": command,
            "verdict": st.just("pass") | anything,
            "results": st.lists(result | anything, max_size=2),
        }
    )
    return report | anything | st.text(max_size=30)


#: TOML values of every type, hardly any of them right where they land.
VALUES = [
    "0", "1", "-1", "0.5", "1e999", "-0.0", "nan", "inf", "-inf", "1e-320", "9" * 400, "0x7f", "30",
    "true", '""', '"x"', '"ggx"', '"lambert"', '"phong"', "'\\0'", '"constant"', '"cosine"',
    '"cap"', '"image"', '"harmonics"', '"point"', '"standard"', '"sobol"', '"furnace"', '"D65"',
    "[]", "[[]]", "[1]", "[1, 2]", "[1, 2, 3]", "[0, 0, 0]", "[0.1, 0.2, 0.3, 0.4]", "[nan]",
    '["furnace"]', '["reciprocity", 3]', "[[400, 1], [500, 2]]", "[[500, 1], [400, 2]]", "[true]",
    "{}", "{tilt_deg = 30, azimuth_deg = 90}", "{tilt_deg = 300}", "{x = {y = 1}}", "1979-05-27",
    "07:32:00", "1979-05-27T07:32:00Z", "[{}]", '"\\u0663"', '"0:85:6"', '"0:85:log6"', '"own"',
    "[" * 300 + "]" * 300, "[" * 3000 + "]" * 3000, "'''\n'''", "1__0", "=", "",
]  # fmt: skip
SCENE_LINES = [
    "[surface]", "[[surface.lobes]]", "[environment]", "[[lights]]", "[ambient]", "[emission]",
    "[view]", "[spectrum]", "[nosuch]", "[[surface]]", "[lights]", "[surface.parameters]",
    'name = "x"', 'model = "ggx"', 'model = "0.5 lambert + 0.5 phong"', 'model = "x.py"', "n = 10",
    "weight = 0.5", "weight = [0.1, 0.2]", "alpha = 0.1", "albedo = [0.1, 0.2]", "radiance = 2",
    "radiance = [1, 2]", 'kind = "cap"', 'kind = "cosine"', 'kind = "image"', 'file = "x.png"',
    'file = ""', "half_angle_deg = 10", "exponent = 1e6", "axis = [0, 0, -1]", "axis = [0, 0, 0]",
    "coefficients = [1]", "coefficients = [[1], [1, 2]]", "top = 1", "bottom = -1", "a = 1",
    "b = -1", "theta_o_deg = [0, 89.999]", "phi_o_deg = []", "wavelengths = [400, 500]",
    "wavelengths = [500]", 'illuminant = "E"', 'illuminant = "D65"', "illuminant = [[400, 1]]",
    'equation = "standard"', "diffuse = 0.5", "gloss = 0", "ambient = 1", "position = [0, 0, 0]",
    "falloff = [0, 0, 0]", "intensity = 1e300", "irradiance = 0", 'kind = "directional"',
    "direction = [1, 0, 0]", "direction = [0, 0, -1]", "radiance = 1e308", "scale = -1", "#", "\0",
]  # fmt: skip
SETTINGS = [
    'checks = ["reciprocity"]\ntheta_o = "0:60:2"\nsamples = 64\n[[models]]\nmodel = "lambert"\n',
    'samples = 64\nmax_time = 1\ninconclusive = "pass"\n[[models]]\nmodel = "lambert"\n'
    'checks = ["reciprocity", "isotropy"]\nparams = { albedo = [0.2, [0.9, 0.5]] }\n'
    "tolerances = { isotropy = 1e-3 }\n",
    'seed = 7\nphi_o = 3\npoints = "independent"\ntolerance = 0.1\n[[models]]\n'
    'model = "phong"\nchecks = ["positivity"]\nparams = { n = "10:100:3" }\nsamples = 64\n'
    '[[models]]\nmodel = "lambert"\nagainst = "lambert_unnormalised"\nchecks = ["equality"]\n',
]
SETTINGS_LINES = [
    "[[models]]", "[models]", "[tool.brdf-check]", "[models.params]", "[models.tolerances]",
    'model = "lambert"', 'model = "nosuch"', 'model = "x.py"', "model = 3", 'checks = ["nosuch"]',
    "checks = []", 'checks = "isotropy"', 'checks = ["sampling"]', "params = 3", "params = {}",
    "params = { albedo = [] }", "params = { albedo = [[]] }", "params = { albedo = 7 }",
    "params = { zzz = 1 }", "tolerances = { isotropy = 1 }", "tolerances = { nosuch = 0.1 }",
    "tolerance = 0", "samples = 0", "samples = 7", "seed = -1", "seed = 18446744073709551615",
    "seed = 18446744073709551616", 'theta_o = "90"', "theta_o = []", "theta_o = [0, [1]]",
    "phi_o = 1e300", 'against = "ggx"', "against = 1", "max_time = 0", "max_time = 1e-3",
    'inconclusive = "maybe"', 'points = "stratified"', "#", "\0",
]  # fmt: skip
EDITS = ("drop", "double", "move", "insert", "insert", "value", "value")


@st.composite
def edited(draw: Any, texts: Sequence[str], lines: Sequence[str]) -> str:
    """One of `texts` with up to five lines dropped, doubled, moved, inserted or given a value."""
    rows = draw(st.sampled_from(list(texts))).splitlines()
    for _ in range(draw(st.integers(0, 5))):
        at = draw(st.integers(0, len(rows) - 1)) if rows else 0
        here = rows[at : at + 1]
        edit = draw(st.sampled_from(EDITS))
        if edit == "drop":
            rows[at : at + 1] = []
        elif edit == "double":
            rows[at:at] = here
        elif edit == "move":
            rows[at : at + 1] = []
            rows[draw(st.integers(0, len(rows))) : 0] = here
        elif edit == "insert":
            rows[at:at] = [draw(st.sampled_from(list(lines)))]
        elif here and "=" in here[0]:
            rows[at] = f"{here[0].partition('=')[0]}= {draw(st.sampled_from(VALUES))}"
    return "\n".join(rows) + "\n"


def scenes() -> st.SearchStrategy[bytes]:
    """The examples with mistakes in them, or anything."""
    examples = [p.read_text(encoding="utf-8") for p in sorted((ROOT / "examples").glob("*.toml"))]
    return edited(examples, SCENE_LINES).map(str.encode) | st.binary(max_size=40)


def settings() -> st.SearchStrategy[bytes]:
    """A project's settings with mistakes in them, or anything."""
    return edited(SETTINGS, SETTINGS_LINES).map(str.encode) | st.binary(max_size=40)
