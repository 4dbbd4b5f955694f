"""Print the polynomial coefficients used in montecarlo_brdf/special.py, with the error of each fit.

Chebyshev fits in 40 digits (mpmath.chebyfit), in the variable t = x*x, so that the printed
doubles can be checked by anyone: python scripts/polynomials.py
"""
import mpmath as mp

mp.mp.dps = 40


def odd_sin(t: mp.mpf) -> mp.mpf:
    x = mp.sqrt(t)
    return mp.pi if x == 0 else mp.sin(mp.pi * x) / x


def even_cos(t: mp.mpf) -> mp.mpf:
    return mp.cos(mp.pi * mp.sqrt(t))


def show(name: str, f, low: float, high: float, terms: int) -> None:
    coefficients, error = mp.chebyfit(f, [mp.mpf(low), mp.mpf(high)], terms, error=True)
    print(f"# {name}: {terms} terms on [{low}, {high}], fit error {mp.nstr(error, 3)}")
    for c in reversed(coefficients):
        print(f"    {float(c)!r},")


if __name__ == "__main__":
    show("sin(pi x)/x in x*x, |x| <= 1/2", odd_sin, 0, 0.25, 9)
    show("cos(pi x) in x*x, |x| <= 1/2", even_cos, 0, 0.25, 9)
