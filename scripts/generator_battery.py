"""Is the counter generator random enough? Streams and pairs of streams against a battery of tests.

`sampling.points` makes word i of a coordinate by five rounds from its pair's key + i, that of
the pair's second coordinate by two more. Streams are taken as a program would meet them:
consecutive and strided counters, far counters, and, because two streams are most easily too much
alike, words taken in turn from pairs and families of streams: keys that differ by one bit,
consecutive keys, replicates of a key, coordinates of a key.

All p-values, and for each stream and test their combination over rounds, must exceed LEVEL over
their number (Bonferroni), so an ideal generator fails with probability LEVEL. Generators that are
known to be bad must fail, ours with too few rounds among them.

Run: python scripts/generator_battery.py [--log2 24] [--rounds 4] [FILE], with FILE for a record.
"""
from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from environment import describe
from randomness_tests import TESTS, U64, Words
from scipy import stats

from montecarlo_brdf.bits import GOLDEN
from montecarlo_brdf.sampling.points import LOW, MULTIPLIER, axis_key, replicate_key

LEVEL = 1e-6
Stream = Callable[[int, int], Words]  # (key, number of words) -> words


ROUNDS = (5, 7)  # of the first and second coordinate of a pair


def scattered(z: Words, rounds: int = ROUNDS[0]) -> Words:
    """`sampling.points.crossed`, some times, on arrays."""
    for _ in range(rounds):
        product = (z & U64(LOW)) * U64(MULTIPLIER)
        z = (product << U64(32)) | (product >> U64(32)) ^ (z >> U64(32))
    return z


def words(key: int, axis: int, indices: Any) -> Words:
    """The words of one coordinate at some indices."""
    return scattered(U64(axis_key(key, axis // 2)) + indices.astype(np.uint64), ROUNDS[axis % 2])


def strided(stride: int, start: int = 0) -> Stream:
    return lambda key, n: words(key, 0, U64(start) + np.arange(n, dtype=np.uint64) * U64(stride))


def in_turn(keys: Callable[[int], list[tuple[int, int]]]) -> Stream:
    """Words 0 of all (key, axis), then words 1, and so on."""

    def stream(key: int, n: int) -> Words:
        family = keys(key)
        indices = np.arange(n // len(family), dtype=np.uint64)
        return np.stack([words(k, a, indices) for k, a in family], axis=1).ravel()

    return stream


STREAMS: dict[str, Stream] = {
    "consecutive": strided(1),
    "every 3rd": strided(3),
    "every 1024th": strided(1024),
    "every 2^32th": strided(1 << 32),
    "from 2^40 on": strided(1, 1 << 40),
    "keys that differ in bit 0": in_turn(lambda k: [(k, 0), (k ^ 1, 0)]),
    "keys that differ in bit 63": in_turn(lambda k: [(k, 0), (k ^ 1 << 63, 0)]),
    "256 consecutive keys": in_turn(lambda k: [((k + i) % 2**64, 0) for i in range(256)]),
    "replicates 0 and 1": in_turn(lambda k: [(replicate_key(k, r), 0) for r in (0, 1)]),
    "4096 replicates": in_turn(lambda k: [(replicate_key(k, r), 0) for r in range(4096)]),
    "coordinates 0 and 1": in_turn(lambda k: [(k, 0), (k, 1)]),
    "five coordinates": in_turn(lambda k: [(k, a) for a in range(5)]),
}


def congruential(key: int, n: int) -> Words:
    """x -> 69069 x + 1 modulo 2^64 in closed form, low and high half swapped."""
    powers = np.full(n, 69069, np.uint64)
    powers[0] = 1
    powers = np.multiply.accumulate(powers)
    sums = np.concatenate([np.zeros(1, np.uint64), np.add.accumulate(powers)[:-1]])
    x = powers * U64(key) + sums
    return (x << U64(32)) | (x >> U64(32))


def unmixed(key: int, n: int) -> Words:
    """Counters without a hash."""
    return U64(key) + np.arange(n, dtype=np.uint64) * U64(GOLDEN)


def too_few_rounds(key: int, n: int) -> Words:
    """Two rounds instead of five."""
    return scattered(U64(key) + np.arange(n, dtype=np.uint64), 2)


def overlapping(key: int, n: int) -> Words:
    """Pairs of streams whose keys were not hashed: the second is the first, one word later."""
    first = scattered(U64(key) + np.arange(n // 2 + 1, dtype=np.uint64))
    return np.stack([first[:-1], first[1:]], axis=1).ravel()


MUTANTS: dict[str, Stream] = {
    "congruential generator": congruential,
    "counter without hash": unmixed,
    "two rounds": too_few_rounds,
    "keys without hash": overlapping,
}


def avalanche(change: Callable[[Words, int], Words], rounds: int, seed: int) -> float:
    """Flip each of 64 input bits: each of the 64 output bits must flip in half of the cases.

    p-value of the chi^2 of the 4096 counts.
    """
    rng = np.random.default_rng(seed)
    inputs = rng.integers(0, 1 << 64, rounds, dtype=np.uint64)
    total = 0.0
    for b in range(64):
        flips = change(inputs, b)
        for o in range(64):
            z = (2 * np.count_nonzero(flips >> U64(o) & U64(1)) - rounds) / rounds**0.5
            total += z * z
    return float(2.0 * min(stats.chi2.cdf(total, 4096), stats.chi2.sf(total, 4096)))


def flipped_counters(inputs: Words, b: int) -> Words:
    """Change of the word when bit b of its index flips."""
    flip = inputs ^ U64(1 << b)
    return scattered(inputs) ^ scattered(flip)


def battery(stream: Stream, log2: int, rounds: int, seed: int) -> dict[str, list[float]]:
    """p-values of all tests in all rounds, and per test of the rounds together."""
    found: dict[str, list[float]] = {}
    keys = np.random.default_rng(seed).integers(0, 1 << 64, rounds, dtype=np.uint64)
    for key in keys:
        data = stream(int(key), 1 << log2)
        for test in TESTS:
            for i, p in enumerate(test(data)):
                found.setdefault(f"{test.__name__} {i}", []).append(max(p, 1e-300))
    together = {name: float(stats.combine_pvalues(p).pvalue) for name, p in found.items()}
    return {**found, "rounds together": list(together.values())}


def verdict(found: dict[str, dict[str, list[float]]]) -> dict[str, Any]:
    """Smallest p-value, where, and whether it is below LEVEL / number of p-values."""
    flat = [(p, s, t) for s, tests in found.items() for t, row in tests.items() for p in row]
    worst, stream, test = min(flat)
    single = [p for p, _, t in flat if t != "rounds together"]
    return {
        "p_values": len(flat),
        "threshold": LEVEL / len(flat),
        "smallest": worst,
        "where": f"{stream}: {test}",
        "uniformity of the p-values (informative)": float(stats.kstest(single, "uniform").pvalue),
        "passed": worst > LEVEL / len(flat),
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--log2", type=int, default=24, help="words per stream and round")
    parser.add_argument("--rounds", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("record", nargs="?")
    args = parser.parse_args()
    started, found = time.perf_counter(), {}
    for name, stream in STREAMS.items():
        found[name] = battery(stream, args.log2, args.rounds, args.seed)
        print(f"{name:28} smallest p {min(map(min, found[name].values())):.2e}", flush=True)
    p = avalanche(flipped_counters, 1 << min(args.log2, 18), args.seed)
    found["flipped counters"] = {"avalanche": [p]}
    result = verdict(found)
    mutants = {n: verdict({n: battery(m, 18, 1, args.seed)}) for n, m in MUTANTS.items()}
    seen = all(not m["passed"] for m in mutants.values())
    print(json.dumps(result, indent=1))
    if args.record:
        record = {**describe(), "words": len(STREAMS) * args.rounds << args.log2, "result": result,
                  "streams": {n: min(map(min, t.values())) for n, t in found.items()},
                  "tests": [f"{t.__name__}: {(t.__doc__ or '').strip()}" for t in TESTS],
                  "mutants": mutants, "seconds": round(time.perf_counter() - started)}  # fmt: skip
        with open(args.record, "w", encoding="utf-8") as file:
            json.dump(record, file, indent=1)
            file.write("\n")
    return 0 if result["passed"] and seen else 1


if __name__ == "__main__":
    sys.exit(main())
