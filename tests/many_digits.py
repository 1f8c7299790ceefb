"""What tests of the theory take in many digits."""

from collections.abc import Callable

import mpmath as mp

with mp.workdps(130):
    ROOT = mp.sqrt(2 * mp.pi)
    Q2 = mp.sqrt(2 / mp.pi)

# coefficients of φ_ν, φ_κ and 1 in the closed forms
CLOSED: dict[str, Callable[[mp.mpf], tuple[mp.mpf, mp.mpf, mp.mpf]]] = {
    "phi_nu": lambda x: (1, 0, 0),
    "phi_kappa": lambda x: (0, 1, 0),
    "phi_p": lambda x: (mp.sqrt(mp.pi / 8) * x, 0, 0),
    "phi_pdot": lambda x: (0, x, 0),
    "phi_alpha": lambda x: (1, -(x**2) / 2, 0),
    "phi_lambda": lambda x: (x**4 / 8, 3 * x**2 / 4, -(x**3) / 2 / ROOT),
    "phi_kappadot": lambda x: (x**2 / 2, 1, -Q2 * x),
    "phi_lambdadot": lambda x: (-3 * x**2, x**4 / 2, 4 * Q2 * x),
    "phi_q": lambda x: ((12 - 7 * x**4) / 12, (x**6 - 36 * x**2) / 24, Q2 * x**3),
    "phi_r": lambda x: (x**3 * (x**4 - 84) / 192, x * (3 * x**4 - 44) / 32, -(x**2) * (x**4 - 60) / 48 / ROOT),
    "phi_s": lambda x: (x**2 * (36 - x**4) / 48, (4 - x**4) / 4, x * (x**4 - 24) / 12 / ROOT),
    "phi_t": lambda x: (x**3 / 3, x * (12 - x**4) / 24, -(x**2) / ROOT),
    "one_minus_phi_p": lambda x: (-mp.sqrt(mp.pi / 8) * x, 0, 1),
    "phi_nu_minus_kappa": lambda x: (1, -1, 0),
    "phi_r_plus_lambda_phi_kappa": lambda x: tuple(map(mp.fadd, CLOSED["phi_r"](x), (0, x, 0))),
    "phi_kappa_minus_s": lambda x: (-(x**2) * (36 - x**4) / 48, x**4 / 4, -x * (x**4 - 24) / 12 / ROOT),
}


def phi_pair(x: mp.mpf) -> tuple[mp.mpf, mp.mpf]:
    """φ_ν and φ_κ (A.5.1), (A.5.2)."""
    s, c = mp.fresnels(x / mp.sqrt(2 * mp.pi)), mp.fresnelc(x / mp.sqrt(2 * mp.pi))
    sine, cosine = mp.sin(x**2 / 4), mp.cos(x**2 / 4)
    return cosine * (1 - 2 * s) - sine * (1 - 2 * c), cosine * (1 - 2 * c) + sine * (1 - 2 * s)


def wave(n: int) -> Callable[[mp.mpf, int], mp.mpc]:
    """Derivatives in x of iⁿerfc(e^{−iπ/4}x/2), by 2n iⁿerfc = i^{n−2}erfc − 2z i^{n−1}erfc either way."""

    def value(x: mp.mpf, m: int) -> mp.mpc:
        turn = mp.exp(-mp.j * mp.pi / 4) / 2
        z = turn * x
        i = {-1: 2 * mp.exp(-z * z) / mp.sqrt(mp.pi), 0: mp.erfc(z)}
        for k in range(-2, n - m - 1, -1):
            i[k] = 2 * z * i[k + 1] + 2 * (k + 2) * i[k + 2]
        for k in range(1, n - m + 1):
            i[k] = (i[k - 2] - 2 * z * i[k - 1]) / (2 * k)
        return (-turn) ** m * i[n - m]

    return value


def row(c: mp.mpc) -> list[mp.mpf]:
    """Coefficients of Re B and Im B in Re(Bc)."""
    return [mp.re(c), -mp.im(c)]


def closed_form(name: str, lam: float, pair: tuple[mp.mpf, mp.mpf]) -> mp.mpf:
    """A φ function, or a difference of two, as the thesis writes it (A.5), from φ_ν and φ_κ."""
    return sum(w * v for w, v in zip(CLOSED[name](mp.mpf(lam)), (*pair, mp.mpf(1)), strict=True))
