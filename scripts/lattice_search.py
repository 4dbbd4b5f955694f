"""Search for the generating vectors in sampling/lattice.py; prints the table.

Component 2 is exhaustive: of all Korobov generators the one with the largest Zaremba index, the
smallest product max(1, |h1|) max(1, |h2|) over the dual lattice h1 + z h2 = 0 mod N; it is attained
at a convergent of z/N, because the product is below N/2. Components 3 to 5 minimise P_4, the
squared error of the worst integrand with two derivatives, over 64 candidates each.
Source: Niederreiter 1992, "Random number generation and quasi-Monte Carlo methods", ch. 5.
"""
from __future__ import annotations

import numpy as np

LARGEST = 20
CANDIDATES = 64
BETWEEN = (144, 448, 648)


def zaremba(n: int) -> np.ndarray:
    """The Zaremba index of the Korobov lattice (1, z) for every odd z < n/2."""
    z = np.arange(1, max(2, n // 2), 2, dtype=np.int64)
    index = np.full(z.shape, n, dtype=np.int64)
    a, b = np.full_like(z, n), z.copy()  # Euclid: remainders are |h1| of the convergents
    q0, q1 = np.zeros_like(z), np.ones_like(z)  # their denominators are h2
    while True:
        index = np.where(b > 0, np.minimum(index, b * q1), index)
        if not b.any():
            return index
        safe = np.where(b > 0, b, 1)
        k = np.where(b > 0, a // safe, 0)
        a, b = np.where(b > 0, b, a), np.where(b > 0, a % safe, 0)
        q0, q1 = q1, np.where(b > 0, k * q1 + q0, q1)


def second(n: int) -> int:
    """The best z; among equals the one with the smallest P_4."""
    index = zaremba(n)
    z = 2 * np.arange(len(index)) + 1
    index = np.where(np.gcd(z, n) == 1, index, 0)
    best = z[index == index.max()]
    return int(min(best, key=lambda z: (p4(n, [1, int(z)]), z)))


def kernel(n: int) -> np.ndarray:
    """sum over h != 0 of e^(2 pi i h x)/h^4 at x = k/n, by Bernoulli's polynomial of degree 4."""
    x = np.arange(n) / n
    return -(2.0 * np.pi) ** 4 / 24.0 * (x**4 - 2.0 * x**3 + x**2 - 1.0 / 30.0)


def factors(n: int, z: int) -> np.ndarray:
    """1 + kernel along one component."""
    return 1.0 + kernel(n)[np.arange(n, dtype=np.int64) * z % n]


def p4(n: int, z: list[int]) -> float:
    """P_4 of the lattice with generating vector z."""
    return float(np.prod([factors(n, c) for c in z], axis=0).mean() - 1.0)


def further(n: int, first: int) -> list[int]:
    """Components 3 to 5, one at a time."""
    rng = np.random.default_rng(n)
    done = factors(n, 1) * factors(n, first)
    chosen: list[int] = []
    for _ in range(3):
        some = np.unique(rng.integers(0, max(1, n // 2), CANDIDATES) * 2 + 1)
        score = {int(z): float((done * factors(n, int(z))).mean()) for z in some}
        chosen.append(min(score, key=lambda z: (score[z], z)))
        done = done * factors(n, chosen[-1])
    return chosen


def degree(n: int, z: int) -> int:
    """The smallest |h1| + |h2| of the dual lattice: the first wave that is not integrated."""
    h = np.arange(1, n)
    other = h * z % n
    return int((h + np.minimum(other, n - other)).min())


def main() -> None:
    """Print the table."""
    print("GENERATORS: dict[int, tuple[int, int, int, int]] = {")
    for m in range(LARGEST + 1):
        n = 1 << m
        first = second(n) if m > 2 else 1
        print(f"    {m}: {(first, *further(n, first))},")
    print("}\nBETWEEN: dict[int, tuple[int, int, int, int]] = {")
    for n in BETWEEN:
        first = second(n)
        print(f"    {n}: {(first, *further(n, first))},")
    print("}")
    for n in (128, 144, 160, 192, 224, 256, 288, 320, 384, 448, 512, 576, 648, 704):
        print(f"# {n}: exact below |h1| + |h2| = {degree(n, second(n))}")


if __name__ == "__main__":
    main()
