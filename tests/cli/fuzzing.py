"""What to throw at the program: strategies shared by the tests and the long runs."""

from __future__ import annotations

from pathlib import Path

from hypothesis import strategies as st

#: Exit codes that are answers; 70 is an internal error, anything else a crash.
ANSWERS = (0, 1, 2, 3, 4, 5)

MODELS = [
    "lambert",
    "lambert_unnormalised",
    "ggx",
    "nosuch",
    "",
    "all.py",
    "lambert.py:",
    ".",
    "/",
    "\0",
]
NUMBERS = [
    "0",
    "1",
    "-1",
    "0.5",
    "1e400",
    "nan",
    "inf",
    "2^",
    "^3",
    "2^2^2",
    "1_0",
    "0x10",
    "1/2",
    "0:1:3",
    "0:1",
    "1:0:log3",
    "0:90:2",
    "::",
    ",",
    "\u0663",
    "1e-320",
    "9" * 500,
]
SAMPLES = ["1", "7", "2^6", "0", "-3", "1e99", "2^99", "x", "", "1.5", "\u0662"]
odd = st.sampled_from(NUMBERS) | st.text(max_size=8)
names = st.sampled_from(MODELS) | st.text(max_size=8)


def _option(flag: str, values: st.SearchStrategy[str]) -> st.SearchStrategy[list[str]]:
    return values.map(lambda v: [flag, v])


def command_lines() -> st.SearchStrategy[list[str]]:
    """Command lines that are short to run whatever they mean."""
    model = _option("--model", names)
    options = st.one_of(
        model,
        _option(
            "-p",
            st.sampled_from(["albedo=", "alpha=", "=1", "f0=1/", "c="]).flatmap(
                lambda a: odd.map(lambda v: a + v)
            ),
        ),
        _option("--theta-o", odd),
        _option("--phi-o", odd),
        _option("--seed", odd),
        _option("--points", st.sampled_from(["sobol", "independent", "", "lattice2"])),
        _option("--sampler", st.sampled_from(["all", "own", "cosine,uniform", ",", "x"])),
        _option("--tolerance", odd),
        _option("--threads", st.sampled_from(["1", "2", "0", "x", "1e9"])),
        _option("--format", st.sampled_from(["text", "json", "yaml", ""])),
        _option(
            "--export-json", st.sampled_from(["FOLDER/r.json", "FOLDER/no/r.json", "FOLDER", ""])
        ),
        _option("--plot", st.sampled_from(["FOLDER/r.png", "FOLDER/r.gif", ""])),
        st.text(max_size=10).map(lambda t: [t]),
    )
    tails = st.lists(options, max_size=5).map(lambda rows: [w for row in rows for w in row])
    few = _option("--samples", st.sampled_from(SAMPLES))  # last, so that it wins
    furnace = st.tuples(model, tails, few).map(lambda t: ["furnace", *t[0], *t[1], *t[2]])
    point = st.lists(odd, min_size=4, max_size=7).map(",".join)
    stress = st.tuples(model, point).map(lambda t: ["stress", *t[0], "--at", t[1]])
    other = st.tuples(st.sampled_from(["show", "models", "plot", "nosuch", ""]), tails)
    free = st.lists(st.text(max_size=12), max_size=4)
    return st.one_of(furnace, stress, other.map(lambda t: [t[0], *t[1]]), free)


def in_folder(arguments: list[str], folder: Path) -> list[str]:
    """The same command line writing into a folder of its own."""
    return [a.replace("FOLDER", str(folder)) for a in arguments]
