"""Raw words of the counter generator, without end, for batteries that read them from a pipe.

    python scripts/generator_words.py [--axes 0,1] [--keys 1] [--stride 1] | RNG_test stdin64

The words of all coordinates and keys come in turn; --rounds says how many instead of ours. What
PractRand said: scripts/results/practrand.md.
"""
from __future__ import annotations

import argparse
import sys

import numpy as np
from generator_battery import ROUNDS, scattered
from randomness_tests import U64

from montecarlo_brdf.sampling.points import axis_key, replicate_key

CHUNK = 1 << 18


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--axes", default="0", help="coordinates whose words come in turn")
    parser.add_argument("--keys", type=int, default=1, help="replicates whose words come in turn")
    parser.add_argument("--stride", type=int, default=1, help="of the counter")
    parser.add_argument("--rounds", type=int, help="for all coordinates")
    args = parser.parse_args()
    axes = [int(a) for a in args.axes.split(",")]
    streams = [(axis_key(replicate_key(1, r), a // 2), a) for r in range(args.keys) for a in axes]
    index = np.arange(CHUNK // len(streams), dtype=np.uint64)
    while True:
        counters = index * U64(args.stride)
        rows = [
            scattered(U64(key) + counters, args.rounds or ROUNDS[axis % 2]) for key, axis in streams
        ]
        try:
            sys.stdout.buffer.write(np.stack(rows, axis=1).tobytes())
        except BrokenPipeError:
            return
        index += U64(len(index))


if __name__ == "__main__":
    main()
