"""Print the coefficients of special.py, compile/sines.py and models/_smith.py, with their errors.

Chebyshev fits in 40 digits (mpmath.chebyfit), so that the printed doubles can be checked by anyone:
python scripts/polynomials.py. Leading terms that must be exact are taken out before fitting.
"""
import mpmath as mp

mp.mp.dps = 40


def odd_sin(t: mp.mpf) -> mp.mpf:
    x = mp.sqrt(t)
    return mp.pi if x == 0 else mp.sin(mp.pi * x) / x


def sin_rest(q: mp.mpf) -> mp.mpf:
    r = mp.sqrt(q)
    return -mp.mpf(1) / 6 if r < 1e-12 else (mp.sin(r) / r - 1) / q


def parts(x: mp.mpf) -> None:
    """x as a sum of three doubles."""
    print("# pi in parts")
    for _ in range(3):
        print(f"    {float(x)!r},")
        x -= mp.mpf(float(x))


def even_cos(t: mp.mpf) -> mp.mpf:
    return mp.cos(mp.pi * mp.sqrt(t))


def exp_rest(r: mp.mpf) -> mp.mpf:
    return mp.nsum(lambda j: r**j / mp.factorial(j + 2), [0, 40])


def log_rest(z: mp.mpf) -> mp.mpf:
    return mp.nsum(lambda j: 2 * z**j / (2 * j + 3), [0, 60]) / mp.log(2)


def asin_rest(z: mp.mpf) -> mp.mpf:
    t = mp.sqrt(z)
    return mp.mpf(1) / 6 if t < 1e-12 else (mp.asin(t) / t - 1) / z


def masked(x: mp.mpf) -> mp.mpf:
    """Lambda/x of Beckmann's distribution, so that mu Lambda = alpha sin masked(x)."""
    return (mp.exp(-x * x) / mp.sqrt(mp.pi) - x * mp.erfc(x)) / 2


def eighth_root(terms: int, reach: int, scale: int, nodes: int = 80) -> None:
    """(masked(x)/masked(0))^(1/8) in s = x/(x + scale) for x <= reach, least squares at Chebyshev's
    points; weights are the error of x + masked(x), relative, that an error of the root makes."""
    end = mp.mpf(reach) / (reach + scale)
    t = [(1 + mp.cos(mp.pi * (k + mp.mpf(1) / 2) / nodes)) / 2 for k in range(nodes)]
    x = [scale * end * v / (1 - end * v) for v in t]
    root = [(masked(a) / masked(mp.mpf(0))) ** (mp.mpf(1) / 8) for a in x]
    weight = [8 * masked(a) / r / (a + masked(a)) for a, r in zip(x, root, strict=True)]
    rows = zip(t, weight, strict=True)
    powers = mp.matrix([[w * v ** (j + 1) for j in range(terms - 1)] for v, w in rows])
    wanted = mp.matrix([w * (r - 1) for r, w in zip(root, weight, strict=True)])
    found = mp.lu_solve(powers.T * powers, powers.T * wanted)
    error = max(abs(e) for e in powers * found - wanted)
    print(f"# (masked(x)/masked(0))^(1/8) in s = x/(x + {scale}), x <= {reach}: {terms} terms,")
    print(f"# fit error of 1 + Lambda {mp.nstr(error, 3)}; from s^0 up")
    for c in (mp.mpf(1), *(found[j] / end ** (j + 1) for j in range(terms - 1))):
        print(f"    {float(c)!r},")


def show(name: str, f, low: float, high: float, terms: int) -> None:
    coefficients, error = mp.chebyfit(f, [mp.mpf(low), mp.mpf(high)], terms, error=True)
    print(f"# {name}: {terms} terms on [{low}, {high}], fit error {mp.nstr(error, 3)}")
    for c in coefficients:
        print(f"    {float(c)!r},")


if __name__ == "__main__":
    half_ln2 = mp.log(2) / 2 * mp.mpf("1.0001")
    largest = ((mp.sqrt(2) - 1) / (mp.sqrt(2) + 1)) ** 2
    show("sin(pi x)/x in x*x, |x| <= 1/2", odd_sin, 0, 0.25, 9)
    show("(sin(r) - r)/r^3 in r*r, |r| <= pi/2", sin_rest, 0, 2.4675, 8)
    parts(mp.pi)
    show("cos(pi x) in x*x, |x| <= 1/2", even_cos, 0, 0.25, 9)
    show("(exp(r) - 1 - r)/r^2, |r| <= ln(2)/2", exp_rest, -half_ln2, half_ln2, 10)
    show("2 (atanh(s) - s)/(s^3 ln 2) in s*s, |s| <= tan(pi/8)^2", log_rest, 0, largest, 8)
    show("(asin(t) - t)/t^3 in t*t, |t| <= sqrt(1/2)", asin_rest, 0, 0.5, 20)
    eighth_root(terms=18, reach=6, scale=16)
