"""The command line that gives a finding of `run` again."""
from __future__ import annotations

import shlex

from montecarlo_brdf.cases.case import Case
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.verify.common import exactly, shown_parameters

RUN_SAMPLES = 1 << 20


def reproduction(case: Case, name: str, plan: Plan) -> str:
    """A command line that gives this finding again."""
    words = ["brdf-check", "run", "--model", case.model.name, "--check", name]
    for key, value in shown_parameters(case.model, case.p).items():
        values = value if isinstance(value, tuple) else (value,)
        if not (case.free and key in {case.model.labels.get(n, n) for n in case.free}):
            words += ["-p", f"{key}={'/'.join(str(v) for v in values)}"]
    words += ["--theta-o", ",".join(map(exactly, case.theta_o_deg))]
    defaults = {
        "--phi-o": (exactly(case.phi_o_deg), "0"),
        "--points": (plan.points, "sobol"),
        "--samples": (plan.samples, RUN_SAMPLES),
        "--seed": (plan.seed, 0),
        "--effort": (plan.effort, 1.0),
        "--against": (case.against.name if case.against else None, None),
    }
    for option, (value, default) in defaults.items():
        words += [option, str(value)] if value != default else []
    if case.tolerance is not None:
        words += ["--tolerance", exactly(case.tolerance)]
    return shlex.join(words)
