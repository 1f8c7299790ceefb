"""The closed forms of the theory as Chebyshev polynomials, which the page evaluates by Clenshaw's rule.

Every number of the theory is a function of κ/ν alone: λ₁ and r₁ are linear in the acceleration α and the axial force N,
the loads that the page asks for. Each has a law of its own at both ends, λ₀ ~ √(π/2)(1 − κ/ν) for κ/ν → 1 and
λ₀ ~ √(2ν/κ) for κ/ν → 0, so that polynomials in κ/ν converge badly. With ν/κ − 1 = √(2/π) b + b²/2 the variable b is
the sum of both laws: it runs from 0 to ∞, λ₀/b is smooth in it, and every φ function is analytic in λ₀ at 0 and has a
series in 1/λ₀ at ∞. Hence

    f(κ/ν) = (1 + b)^p Σ c_k T_k(u),   u = (b − 3)/(b + 3) ∈ [−1, 1),

with p the power with which f grows (κ/ν)^{−p/2}. Where the beam touches in one point, κ/ν ≥ 1, b = 0 is the limit.
"""

from collections.abc import Callable
from functools import cache, partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.special import wofz

from theory import contact_parameters
from theory.second_order import second_order
from theory.similarity import peak_moment, wave_amplitude

Array = NDArray[np.float64]
Function = Callable[[Array], Array]
MIDDLE = 3.0  # b where u = 0
BREAKS = (-1.0, -0.5, 0.5, 1.0)
FLATTEST = 5e-4  # κ/ν: beyond, λ₂ and r₂ lose digits
NODES = 40
NODES_OF_SECOND_ORDER = 20  # within 1e-5: only limits need it
DIGITS = 13  # of the largest coefficient: smaller ones are left out
SLOPE = np.sqrt(2.0 / np.pi)
TURN = np.exp(-0.25j * np.pi) / 2.0  # z = TURN·x


def _steepest(kappa: Array) -> Array:
    """Largest slope |E′| of the wave E = Re[A e^{i(x² − λ₀²)/4} e^{z²} i²erfc z], z = e^{−iπ/4}x/2: where E″ = 0,
    between the front and the largest moment ahead of it; found by halving."""

    def erfc(x: Array) -> NDArray[np.complex128]:  # e^{z²} erfc z
        return np.asarray(wofz(1j * TURN * x))

    contact = contact_parameters(kappa)
    front, amplitude = contact.lambda0, wave_amplitude(contact)
    low, high = front, peak_moment(kappa).place
    for _ in range(60):
        x = (low + high) / 2.0
        wave = amplitude * np.exp(0.25j * (x**2 - front**2)) * TURN
        bent = (wave * TURN * erfc(x)).real > 0.0
        low, high = np.where(bent, low, x), np.where(bent, x, high)
    return np.abs((wave * (1.0 / np.sqrt(np.pi) - TURN * x * erfc(x))).real)


@cache
def _quadratic(kappa: float, sign: float) -> dict[str, float]:
    """λ₂ and r₂ are quadratic in α and N while their sum keeps its sign: factors by order_loads. Below
    `FLATTEST` they go with λ₀ and r₀, and N with κ (`theory.validity`)."""
    like = max(kappa, FLATTEST)
    loads = {"alpha": (sign, 0.0), "axial": (0.0, sign), "both": (sign, sign)}
    found = {name: second_order(contact_parameters(like, alpha, axial=n)) for name, (alpha, n) in loads.items()}
    here, there = contact_parameters(kappa), contact_parameters(like)
    flatter, factors = kappa / like, dict[str, float]()
    for order, grown in (("lambda2", here.lambda0 / there.lambda0), ("r2", here.r0 / there.r0)):
        alpha, axial, both = (float(getattr(found[name], order)) * float(grown) for name in ("alpha", "axial", "both"))
        factors |= {f"{order}_alpha": alpha, f"{order}_axial": axial * flatter**2}
        factors[f"{order}_both"] = (both - alpha - axial) * flatter
    return factors


def _second(kappa: Array, name: str, sign: float) -> Array:
    return np.array([_quadratic(float(one), sign)[name] for one in kappa])


def _functions() -> dict[str, tuple[int, Function]]:
    """Name → (p, f), ν = 1. λ₁ and r₁ per unit of α, whose sign decides between continuous and detached contact."""
    of = contact_parameters
    found: dict[str, tuple[int, Function]] = {
        "lambda0": (1, lambda k: of(k).lambda0),
        "r0": (1, lambda k: of(k).r0),
        "lambda1_continuous": (1, lambda k: of(k, 1.0).lambda1),
        "lambda1_detached": (1, lambda k: -of(k, -1.0).lambda1),
        "r1_continuous": (1, lambda k: of(k, 1.0).r1),
        "r1_detached": (1, lambda k: -of(k, -1.0).r1),
        "lambda_axial": (-1, lambda k: of(k).lambda_axial),
        "r_axial": (-1, lambda k: of(k).r_axial),
        "moment_ahead": (0, lambda k: peak_moment(k).ahead),
        "steepest": (-1, _steepest),
    }
    for regime, sign in (("continuous", 1.0), ("detached", -1.0)):
        for order in ("lambda2", "r2"):
            for loads, power in (("alpha", 1), ("both", -1), ("axial", -3)):
                name = f"{order}_{loads}"
                found[f"{name}_{regime}"] = (power, partial(_second, name=name, sign=sign))
    return found


def _fit(power: int, function: Function, nodes: int) -> list[list[float]]:
    """Coefficients of f/(1 + b)^p over u on each interval: the interpolant at Chebyshev points."""
    points, pieces = chebyshev.chebpts1(nodes), []
    for low, high in pairwise(BREAKS):
        u = low + (high - low) * (points + 1.0) / 2.0
        b = MIDDLE * (1.0 + u) / (1.0 - u)  # 0 … ∞
        scaled = function(1.0 / (1.0 + SLOPE * b + b**2 / 2.0)) / (1.0 + b) ** power
        found = chebyshev.chebfit(points, scaled, nodes - 1)
        digits = DIGITS - int(np.ceil(np.log10(np.abs(found).max())))
        pieces.append(chebyshev.chebtrim(found.round(digits)).tolist())
    return pieces


@cache
def coefficients() -> dict[str, Any]:
    """``breaks`` of u, and ``functions``: name → ``power`` and ``pieces``, the coefficients on each interval."""
    functions = {
        name: {"power": power, "pieces": _fit(power, function, NODES_OF_SECOND_ORDER if "2_" in name else NODES)}
        for name, (power, function) in _functions().items()
    }
    return {"breaks": list(BREAKS), "middle": MIDDLE, "functions": functions}
