"""Print the polynomial coefficients used in montecarlo_brdf/special.py, with the error of each fit.

Chebyshev fits in 40 digits (mpmath.chebyfit), so that the printed doubles can be checked by anyone:
python scripts/polynomials.py. Leading terms that must be exact are taken out before fitting.
"""
import mpmath as mp

mp.mp.dps = 40


def odd_sin(t: mp.mpf) -> mp.mpf:
    x = mp.sqrt(t)
    return mp.pi if x == 0 else mp.sin(mp.pi * x) / x


def even_cos(t: mp.mpf) -> mp.mpf:
    return mp.cos(mp.pi * mp.sqrt(t))


def exp_rest(r: mp.mpf) -> mp.mpf:
    return mp.nsum(lambda j: r**j / mp.factorial(j + 2), [0, 40])


def log_rest(z: mp.mpf) -> mp.mpf:
    return mp.nsum(lambda j: 2 * z**j / (2 * j + 3), [0, 60]) / mp.log(2)


def asin_rest(z: mp.mpf) -> mp.mpf:
    t = mp.sqrt(z)
    return mp.mpf(1) / 6 if t < 1e-12 else (mp.asin(t) / t - 1) / z


def erfcx(s: mp.mpf) -> mp.mpf:
    a = (1 + s) / (1 - s) * 2
    return mp.exp(a * a) * mp.erfc(a)


def show(name: str, f, low: float, high: float, terms: int) -> None:
    coefficients, error = mp.chebyfit(f, [mp.mpf(low), mp.mpf(high)], terms, error=True)
    print(f"# {name}: {terms} terms on [{low}, {high}], fit error {mp.nstr(error, 3)}")
    for c in coefficients:
        print(f"    {float(c)!r},")


if __name__ == "__main__":
    half_ln2 = mp.log(2) / 2 * mp.mpf("1.0001")
    largest = ((mp.sqrt(2) - 1) / (mp.sqrt(2) + 1)) ** 2
    show("sin(pi x)/x in x*x, |x| <= 1/2", odd_sin, 0, 0.25, 9)
    show("cos(pi x) in x*x, |x| <= 1/2", even_cos, 0, 0.25, 9)
    show("(exp(r) - 1 - r)/r^2, |r| <= ln(2)/2", exp_rest, -half_ln2, half_ln2, 10)
    show("2 (atanh(s) - s)/(s^3 ln 2) in s*s, |s| <= tan(pi/8)^2", log_rest, 0, largest, 8)
    show("(asin(t) - t)/t^3 in t*t, |t| <= sqrt(1/2)", asin_rest, 0, 0.5, 20)
    show("exp(a^2) erfc(a) in s = (a - 2)/(a + 2), 0 <= a <= 7", erfcx, -1, mp.mpf(5) / 9, 20)
