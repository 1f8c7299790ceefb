"""The fast part of an impact in similarity coordinates, one implicit step at a time (:mod:`self_similar_fe.run`).

    M η_ss + C η_s + A η + nτ G η = ρ,   0 ≤ ρ ⊥ η − W₀ ≥ 0 at the nodes

with the Galerkin matrices of D(D + 1) + σ(D + 1) + ∂⁴ − nτ∂², D = ∂_s − (ζ/2)∂_ζ, on Hermite elements in ζ = ξ/√τ.
"""

import dataclasses
import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse
from numpy.polynomial import polynomial
from numpy.typing import NDArray
from scipy.linalg import solve_banded

from self_similar_fe.mesh import Array, ExpandingMesh

GAP_ROUND_OFF = 1e-10  # in W, that is V₀t; at 1e-9 pressed zones rest on so few nodes that λ₁, r₁ scatter by 2 %
FAST = 0.75  # of the round before: all wrong contacts are exchanged while their number falls below this share of it
FEW = 2  # runs up to this length are exchanged whole
PATIENCE = 10  # rounds without progress before only the last wrong one is exchanged (Murty's rule)
ONE_BY_ONE = 40  # of those rounds before both tolerances are widened tenfold; with 30 r₁ scatters more
MOST_ROUNDS = 500  # in a step
BAND = 3  # half-bandwidth of Hermite elements: two nodes of two degrees of freedom


@dataclass(frozen=True)
class _Operators:
    """mass M, drift C, steady A of M η_ss + C η_s + A η = ρ, absorber included, and parts of them; CSR, (2n, 2n)."""

    mass: sparse.csr_matrix
    drift: sparse.csr_matrix
    steady: sparse.csr_matrix
    bending: sparse.csr_matrix  # ∫ N″ N″ᵀ, a part of A
    tension: sparse.csr_matrix  # ∫ N′ N′ᵀ
    damping: sparse.csr_matrix  # ∫ σ N Nᵀ, a part of C and A
    damped: sparse.csr_matrix  # ∫ σ N (D₀N)ᵀ, D₀ = −(ζ/2)∂_ζ, a part of A


POINTS, WEIGHTS = np.polynomial.legendre.leggauss(6)


def _operators(zeta: Array, sigma: Callable[[Array], Array]) -> _Operators:
    """Galerkin matrices of D(D + 1) + σ(D + 1) + ∂⁴ on Hermite elements; D's second factor is integrated by parts."""
    length, n = np.diff(zeta), zeta.size
    points = (POINTS[:, None] + 1.0) / 2.0
    place, dl = zeta[:-1] + points * length, WEIGHTS[:, None] / 2.0 * length
    shape, slope, bend = (_shapes(points, length, d) for d in (0, 1, 2))
    advected = -0.5 * place[:, :, None] * slope  # −(ζ/2) N′
    dofs = 2 * np.arange(n - 1)[:, None] + np.arange(4)
    rows, columns = np.repeat(dofs, 4, axis=1).ravel(), np.tile(dofs, (1, 4)).ravel()

    def integral(left: Array, right: Array, weight: float | Array = 1.0) -> sparse.csr_matrix:
        blocks = np.zeros((n - 1, 4, 4))
        for w, tested, trial in zip((weight * dl)[:, :, None, None], left, right):
            blocks += w * tested[:, :, None] * trial[:, None, :]
        return sparse.csr_matrix((blocks.ravel(), (rows, columns)), shape=(2 * n, 2 * n))

    m, g, k = integral(shape, shape), integral(shape, advected), integral(bend, bend)
    s = integral(0.5 * shape - advected, advected)  # the first D's adjoint is on the test function
    ms, gs = integral(shape, shape, sigma(place)), integral(shape, advected, sigma(place))
    drift, steady = m + 2.0 * g + ms, s + g + k + ms + gs
    return _Operators(m, drift, steady, bending=k, tension=integral(slope, slope), damping=ms, damped=gs)


CUBICS = np.array([[1.0, 0.0, -3.0, 2.0], [0.0, 1.0, -2.0, 1.0], [0.0, 0.0, 3.0, -2.0], [0.0, 0.0, -1.0, 1.0]])
"""Hermite's four cubics on [0, 1] (thesis A.6), coefficients by rising power."""


def _shapes(points: Array, length: Array, derivative: int) -> Array:
    """Hermite shape functions of elements of several lengths at ``points`` ∈ [0, 1] (g, 1), d/dx, shape
    (g, elements, 4)."""
    unit = polynomial.polyval(points, polynomial.polyder(CUBICS, derivative, axis=1).T)
    scale = np.ones((length.size, 4))
    scale[:, 1::2] = length[:, None]
    return np.asarray(np.moveaxis(unit, 0, -1) * scale / length[:, None] ** derivative)


class Similarity:
    """State of the fast part in ζ and its implicit Euler step: η, u = ∂_s η, nodal reactions ρ, contact set.

    Made with the held start of a beam without loads on ``mesh``, laid around ``front``; then :meth:`set_step`, and
    :meth:`step` from there on.
    """

    def __init__(self, mesh: ExpandingMesh, front: float, kappa_over_nu: float) -> None:
        zeta, absorber = mesh.lay(front)
        end = zeta[-1]
        top = mesh.absorber_strength * 0.5 * (absorber + end) / (end - absorber)
        self.zeta = zeta
        self.operators = _operators(zeta, lambda z: top * np.clip((z - absorber) / (end - absorber), 0.0, None) ** 3)
        o = self.operators
        self._undamped_drift, self._undamped_steady = o.drift - o.damping, o.steady - o.damping - o.damped
        self.dofs = 2 * zeta.size
        self.rate = np.zeros(self.dofs)
        self.inertia = np.zeros(self.dofs)
        self.widened = 1.0  # tolerances over round-off, most of all steps
        self.push, self.pull = 0.0, 0.0  # largest of a contact in any step
        self.iterations = 0
        self._hold_start(leading_obstacle(zeta, kappa_over_nu))

    def set_step(self, backward: float, tension: float = 0.0) -> None:
        """``backward`` = b of ∂_s f ≈ b (f − f_old): τ_new/h for Euler, 0 for the steady state; ``tension`` nτ."""
        self.backward, self.tension = backward, tension
        o = self.operators
        self.matrix = (backward**2 * o.mass + backward * o.drift + o.steady + tension * o.tension).tocsr()
        self._bands = self.matrix.todia().data[::-1]  # from the highest diagonal down
        # a deflection is known to some ulp of 1, so a reaction to that times the stiffness it is computed with; errors
        # far from a contact have long levers
        self._round_off = 1600.0 * np.finfo(float).eps * np.abs(self.matrix.diagonal()[0::2])

    def _solve(self, right: Array, obstacle: Array, active: NDArray[np.bool_]) -> tuple[Array, Array]:
        """η with η = obstacle on the active nodes, and the nodal reactions there."""
        bands, b, n = self._bands.copy(), right.copy(), self.dofs
        held = np.concatenate([2 * np.flatnonzero(active), [1, n - 2, n - 1]])  # symmetry at 0, rest at the end
        for k in range(-BAND, BAND + 1):
            column = held + k
            inside = (column >= 0) & (column < n)
            bands[BAND - k, column[inside]] = 1.0 if k == 0 else 0.0
        b[0::2][active] = obstacle[active]
        b[1] = b[-2] = b[-1] = 0.0
        try:
            eta = solve_banded((BAND, BAND), bands, b, overwrite_b=True, check_finite=False)
        except np.linalg.LinAlgError:
            raise ArithmeticError("the expanding mesh's matrix is singular") from None
        reaction = np.where(active, (self.matrix @ eta - right)[0::2], 0.0)
        return eta, reaction

    def _hold_start(self, obstacle: Array) -> None:
        """The self-similar state with the nodes behind the front held, which is the last node for which holding
        everything up to it still pushes it away from the wall.
        """
        self.set_step(0.0)
        zero = np.zeros(self.dofs)
        low, high = 0, int(np.flatnonzero(obstacle > 0.0).max())
        while low < high:
            middle = (low + high + 1) // 2
            active = np.arange(self.zeta.size) <= middle
            _, reaction = self._solve(zero, obstacle, active)
            if reaction[middle] > 0.0:
                low = middle
            else:
                high = middle - 1
        self.active = np.arange(self.zeta.size) <= low
        self.eta, self.reaction = self._solve(zero, obstacle, self.active)

    def step(self, obstacle: Array) -> None:
        """One implicit Euler step; ``obstacle`` (n,) is W₀ at the new time where contact may occur, −1 elsewhere.

        Contacts of wrong sign are exchanged: all while their number falls fast, then the worst of each run of
        neighbours (a beam is stiff over a few nodes, so that this mends the others), then the last alone, as
        :mod:`hermite_fe.active_set` does. What is widened where they still cycle is ``widened``.

        Raises ``ArithmeticError`` when the active set does not settle.
        """
        b, o = self.backward, self.operators
        old, old_rate = b * self.eta, b * self.rate
        right = o.mass @ (b * old + old_rate) + o.drift @ old
        active, slack, before, fewest, patience = self.active, 1.0, self.zeta.size + 1, self.zeta.size + 1, PATIENCE
        for _ in range(MOST_ROUNDS):
            self.iterations += 1
            eta, reaction = self._solve(right, obstacle, active)
            excess = np.where(active, -reaction / self._round_off, (obstacle - eta[0::2]) / GAP_ROUND_OFF)
            excess[-1] = 0.0
            wrong = excess > slack
            count = int(np.count_nonzero(wrong))
            if count == 0:
                break
            patience = PATIENCE if count < fewest else patience - 1
            if patience == -ONE_BY_ONE:  # contacts that touch without load cycle at round-off
                slack, fewest, patience = 10.0 * slack, self.zeta.size + 1, PATIENCE
            if patience <= 0:
                wrong[: np.flatnonzero(wrong)[-1]] = False
            elif count > FAST * before:
                wrong = worst_of_runs(np.where(wrong, excess, 0.0), active)
            active, before, fewest = active ^ wrong, count, min(fewest, count)
        else:
            raise ArithmeticError("the active set does not settle")
        self.widened = max(self.widened, slack)
        self.push = max(self.push, float(reaction.max()))
        self.pull = max(self.pull, -float(reaction.min()))
        if not np.all(np.isfinite(eta)):
            raise ArithmeticError("the solution is no longer finite")
        rate = b * eta - old
        self.inertia = b * (rate - self.rate)
        self.rate = rate
        self.eta, self.reaction, self.active = eta, reaction, active

    @property
    def front(self) -> float:
        """Centroid of the reaction on ζ ≥ 0."""
        total = self.reaction.sum()
        return float((self.reaction @ self.zeta) / total) if total > 0.0 else 0.0

    def internal_force(self) -> Array:
        """M η_ss + C η_s + (A + nτG) η of the last step, (dofs,), without the absorber in C and A: inertia and
        stiffness as the scheme has them."""
        force = self.operators.mass @ self.inertia + self._undamped_drift @ self.rate + self._undamped_steady @ self.eta
        return np.asarray(force + self.tension * (self.operators.tension @ self.eta))

    def stored(self, velocity: Array) -> float:
        """½vᵀMv + ½ηᵀ(K + nτG)η: kinetic and strain energy over √τ."""
        o = self.operators
        stiff = o.bending @ self.eta + self.tension * (o.tension @ self.eta)
        return 0.5 * float(velocity @ (o.mass @ velocity) + self.eta @ stiff)


def worst_of_runs(excess: Array, active: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The worst of each run of neighbours that are wrong alike; runs of two whole."""
    chosen = excess > 0.0
    edges = np.flatnonzero(np.diff(np.where(chosen, 1 + active, 0), prepend=0, append=0))
    for start, end in itertools.pairwise(edges.tolist()):
        if end - start > FEW and chosen[start]:
            chosen[start:end] = False
            chosen[start + int(np.argmax(excess[start:end]))] = True
    return chosen


def leading_obstacle(zeta: Array, kappa_over_nu: float) -> Array:
    """W₀ without loads."""
    return 1.0 - 0.5 * kappa_over_nu * zeta**2


def similarity(kappa_over_nu: float, mesh: ExpandingMesh) -> Similarity:
    """The held start on a mesh laid around the front that coarser starts located; κ/ν ≥ 1 contacts at 0 alone."""
    front = 0.0 if kappa_over_nu >= 1.0 else math.sqrt(2.0 / kappa_over_nu)  # free beam's reach: 1 = κζ²/2
    coarse = dataclasses.replace(
        mesh,
        front_resolution=max(0.05, mesh.front_resolution),
        growth=max(0.05, mesh.growth),
        elements_per_wave=ExpandingMesh.elements_per_wave,
        interior_elements=ExpandingMesh.interior_elements,
    )
    for _ in range(40 if front > 0.0 else 0):
        before, front = front, max(Similarity(coarse, front, kappa_over_nu).front, 0.3 * front)
        if abs(front - before) < 0.02 * before:
            break
    front = float(f"{front:.6e}")  # the same mesh for the same problem in other units, whose front differs by round-off
    return Similarity(mesh, front, kappa_over_nu)
