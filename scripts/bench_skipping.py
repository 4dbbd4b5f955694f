"""What skipping saves, as ratios of times in one run: python scripts/bench_skipping.py [RESULT.txt]

Each row is a pair of scenes that must give the same radiance; both are timed alternately and the
median of their ratios is printed with what the specification asks for.
"""

import functools
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import montecarlo_brdf as mb
from montecarlo_brdf.estimate.plan import Plan
from montecarlo_brdf.scene import plan, radiance, skies
from montecarlo_brdf.scene.plan import Method, Share, Work
from montecarlo_brdf.scene.scene import Directional, Scene
from montecarlo_brdf.scene.skies import cap_of
from montecarlo_brdf.scene.surface import Surface, lobes_of
from montecarlo_brdf.vectors import from_degrees

WO = from_degrees(40.0)
SAMPLES = 1 << 20
ROUNDS = 9
SLOPE = skies.Linear(1.0, 0.5)  # a sky that is not constant


def surface(spec: str, channels: int = 1, **values: Any) -> Surface:
    """A model or mixture in some channels."""
    model = mb.load(spec)
    return Surface(tuple(lobes_of(model, model.parameters(**values), (1.0,) * channels, channels)))


def scene(made: Surface, channels: int = 1, shape: Any = SLOPE, **more: Any) -> Scene:
    """The surface under a sky that is not constant."""
    sky = skies.Sky((shape,) * channels, (1.0,) * channels)
    dark = (0.0,) * channels
    return replace(Scene("bench", channels, made, sky, ambient=dark, emission=dark), **more)


def run(made: Scene, skip: bool = True, samples: int = SAMPLES) -> Callable[[], Any]:
    """Plan and measure."""
    return lambda: radiance.measure(plan.make(made, skip), WO, Plan(samples=samples))


def seconds(action: Callable[[], Any]) -> float:
    """Of one call."""
    start = time.perf_counter()
    action()
    return time.perf_counter() - start


def ratio(one: Callable[[], Any], other: Callable[[], Any], rounds: int = ROUNDS) -> float:
    """Median of time(one)/time(other), interleaved, after a first call of each."""
    one(), other()
    return statistics.median(seconds(one) / seconds(other) for _ in range(rounds))


def lambert_as_mixture() -> tuple[str, float, str]:
    """A weight of zero costs nothing."""
    mixture = scene(surface("1 lambert + 0 ggx"))
    return (
        "Lambert + 0 GGX / Lambert",
        ratio(run(mixture), run(scene(surface("lambert")))),
        "<= 1.1",
    )


def equal_channels() -> tuple[str, float, str]:
    """Equal channels are estimated once."""
    grey = scene(surface("ggx", 3), 3)
    return (
        "GGX in 3 equal channels / 1 channel",
        ratio(run(grey), run(scene(surface("ggx")))),
        "<= 1.1",
    )


def dark_lights() -> tuple[str, float, str]:
    """Lights that do not shine are not evaluated."""
    lamp = Directional((0.0, 0.6, 0.8), (1.0,))
    black = [Directional((0.0, 0.6, 0.8), (0.0,))] * 50
    below = [Directional((0.0, 0.6, -0.8), (1.0,))] * 49
    made = surface("ggx")
    many, one = scene(made, lights=(lamp, *black, *below)), scene(made, lights=(lamp,))
    return "100 lights of which 99 dark / 1 light", ratio(run(many), run(one)), "<= 1.2"


def black_sky() -> tuple[str, float, str]:
    """A delta light under a black sky is one exact sum."""
    lamp = Directional((0.0, 0.6, 0.8), (1.0,) * 3)
    made = scene(surface("0.5 lambert + 0.5 ggx", 3), 3, lights=(lamp,))
    made = replace(made, sky=made.sky._replace(scales=(0.0,) * 3))  # type: ignore[union-attr]
    long = run(made, skip=False, samples=1 << 22)
    return "black sky, one lamp: --no-skip / skipping", ratio(long, run(made), 3), ">= 1000"


def small_cap() -> tuple[str, float, str]:
    """Time to a relative standard error of 1e-4: the hemisphere's over the cap's own samples."""
    cap = cap_of(1.0, from_degrees(30.0))
    made = scene(surface("lambert", albedo=1.0), shape=cap)
    lobe = made.surface.lobes[0]  # type: ignore[union-attr]
    work = Work("lambert", lobe.model, ((lobe.sets[0], cap),), (Share(0, 1.0),), Method.COSINE)
    hemisphere = plan.make(made)._replace(works=[work])
    times = [_time_to(p, 1e-4) for p in (hemisphere, plan.make(made))]
    return "cap of 1 degree to 1e-4: hemisphere / cap", times[0] / times[1], ">= 100"


def _time_to(made: plan.ScenePlan, error: float) -> float:
    """Samples are doubled until the relative error bar is small enough; the last call counts."""
    samples = 1 << 6
    while True:
        sampling = Plan(points="sobol", samples=samples)
        (found,) = radiance.measure(made, WO, sampling)
        if 0.0 < found.estimate.stderr <= error * found.estimate.mean:
            again = functools.partial(radiance.measure, made, WO, sampling)
            return min(seconds(again) for _ in range(5))
        samples *= 2


def main() -> None:
    """Print, and write to a file if one is given."""
    questions = (lambert_as_mixture, equal_channels, dark_lights, black_sky, small_cap)
    lines = ["What skipping saves: ratios of times within one run (median of interleaved pairs)."]
    for question in questions:
        name, value, wanted = question()
        lines.append(f"{name:48} {value:12.4g}   {wanted}")
        print(lines[-1], flush=True)
    if len(sys.argv) > 1:
        Path(sys.argv[1]).write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
