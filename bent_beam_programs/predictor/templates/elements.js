"use strict";
// Hermite's beam element with shear (Friedman & Kosmatka 1993, Comput. Struct. 47, 473), banded matrices, factors.
// Units EI = μ = 1. A node has the dofs 2j (deflection) and 2j + 1 (angle of the section).
const Elements = (() => {
  const GAUSS = [[0.06943184420297371, 0.17392742256872692], [0.33000947820757187, 0.32607257743127305]]
    .flatMap(([x, weight]) => [[x, weight], [1 - x, weight]]);
  const PAD = 3; // idle dofs before and after: no loop asks where the band ends

  /** Stiffness, mass, and ∫w′w′dx of an element of length l; shear: κ_sGA (0: none), turning: ρI. */
  function element(l, shear, turning) {
    const phi = shear ? 12 / (shear * l * l) : 0, c = 1 / (1 + phi), table = () => [0, 1, 2, 3].map(() => [0, 0, 0, 0]);
    const [K, M, G] = [table(), table(), table()];
    for (const [x, weight] of GAUSS) {
      const w = [1 + phi - phi * x - 3 * x * x + 2 * x ** 3, l * x * (1 - x) * (1 - x + phi / 2),
        phi * x + 3 * x * x - 2 * x ** 3, -l * x * (1 - x) * (x + phi / 2)].map((f) => c * f);
      const slope = [-phi - 6 * x + 6 * x * x, l * (1 + phi / 2 - (4 + phi) * x + 3 * x * x),
        phi + 6 * x - 6 * x * x, l * (-phi / 2 - (2 - phi) * x + 3 * x * x)].map((f) => c * f / l);
      const angle = [6 * x * (x - 1) / l, (1 - x) * (1 - 3 * x + phi), 6 * x * (1 - x) / l, x * (3 * x - 2 + phi)]
        .map((f) => c * f);
      const bent = [(12 * x - 6) / l, 6 * x - 4 - phi, (6 - 12 * x) / l, 6 * x - 2 + phi].map((f) => c * f / l);
      for (let i = 0; i < 4; i++) for (let j = 0; j < 4; j++) {
        K[i][j] += weight * l * (bent[i] * bent[j] + shear * (slope[i] - angle[i]) * (slope[j] - angle[j]));
        M[i][j] += weight * l * (w[i] * w[j] + turning * angle[i] * angle[j]);
        G[i][j] += weight * l * slope[i] * slope[j];
      }
    }
    return { K, M, G };
  }

  /** Equal elements in lower bands: A[m][i] couples the dofs i and i + m. */
  function assembled(nodes, table) {
    const A = [0, 1, 2, 3].map(() => new Float64Array(2 * nodes + 2 * PAD));
    for (let e = 0; e < nodes - 1; e++) for (let i = 0; i < 4; i++) for (let j = 0; j <= i; j++)
      A[i - j][PAD + 2 * e + j] += table[i][j];
    return A;
  }
  const row = (A, x, i) => A[0][i] * x[i] + A[1][i] * x[i + 1] + A[1][i - 1] * x[i - 1] + A[2][i] * x[i + 2]
    + A[2][i - 2] * x[i - 2] + A[3][i] * x[i + 3] + A[3][i - 3] * x[i - 3];

  /** S = UDUᵀ without the fixed dofs, from the tip on, so that an exchange in the middle is cheap; x solves S x = b. */
  function factors(S, fixed) {
    const size = S[0].length, [D, U1, U2, U3] = S.map((band) => new Float64Array(band.length)), [S0, S1, S2, S3] = S;
    D.fill(1);
    return {
      from(last) {
        for (let i = last; i >= PAD; i--) {
          if (fixed[i]) { D[i] = 1; U1[i] = U2[i] = U3[i] = 0; continue; }
          const c = fixed[i + 3] ? 0 : S3[i], b = (fixed[i + 2] ? 0 : S2[i]) - U1[i + 2] * c;
          const a = (fixed[i + 1] ? 0 : S1[i]) - U1[i + 1] * b - U2[i + 1] * c;
          U1[i] = a * D[i + 1]; U2[i] = b * D[i + 2]; U3[i] = c * D[i + 3];
          D[i] = 1 / (S0[i] - U1[i] * a - U2[i] * b - U3[i] * c);
        }
      },
      solve(x) {
        for (let i = size - PAD - 1; i >= PAD; i--) x[i] -= U1[i] * x[i + 1] + U2[i] * x[i + 2] + U3[i] * x[i + 3];
        for (let i = PAD; i < size - PAD; i++)
          x[i] = x[i] * D[i] - U1[i - 1] * x[i - 1] - U2[i - 2] * x[i - 2] - U3[i - 3] * x[i - 3];
      },
    };
  }

  return { PAD, element, assembled, row, factors };
})();
