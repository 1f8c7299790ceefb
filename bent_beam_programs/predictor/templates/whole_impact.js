"use strict";
// The whole impact from the stored MAP: bilinear in ln κ/ν and ln η/T* (comparison/whole_impact/stored_map.py).
const WholeImpact = (() => {
  const { log, abs, min, max, hypot } = Math;

  /** The interval of a grid that holds a value, and how far along. */
  function place(grid, value) {
    let i = 0;
    while (i < grid.length - 2 && grid[i + 1] <= value) i++;
    return [i, min(max(log(value / grid[i]) / log(grid[i + 1] / grid[i]), 0), 1)];
  }

  /** Largest second difference of `values` at i and i + 1. */
  function bend(values, i) {
    const inner = [i, i + 1].filter((k) => k > 0 && k < values.length - 1);
    return max(0, ...inner.map((k) => abs(values[k - 1] - 2 * values[k] + values[k + 1])));
  }

  function interpolated({ values, errors }, [i, u], [j, v]) {
    const corners = [
      [i, j, (1 - u) * (1 - v)], [i, j + 1, (1 - u) * v], [i + 1, j, u * (1 - v)], [i + 1, j + 1, u * v],
    ];
    const used = corners.filter(([, , weight]) => weight > 1e-12);
    const column = (k) => values.map((row) => row[k]);
    const spread = 2 * u * (1 - u) * max(bend(column(j), i), bend(column(j + 1), i))
      + 2 * v * (1 - v) * max(bend(values[i], j), bend(values[i + 1], j));
    return {
      value: used.reduce((sum, [k, l, weight]) => sum + weight * values[k][l], 0),
      error: hypot(max(...used.map(([k, l]) => errors[k][l])), spread),
    };
  }

  /** Restitution, last contact (T*) and peak moment (V₀√(EIμ)), each {value, error}; null off the map. */
  function at(ratio, damping) {
    const { kappa_over_nu: kappas, damping: dampings, numbers, bands } = MAP;
    const kappa = min(ratio, kappas[kappas.length - 1]);
    if (kappa < kappas[0] || damping > dampings[dampings.length - 1]) return null;
    const band = damping < dampings[0], found = { band };
    for (const name of Object.keys(numbers)) {
      if (band) { // without damping the impact scatters: mean and standard deviation
        const [j, v] = place(bands.kappa_over_nu, kappa);
        const [value, error] = [0, 1].map((k) => (1 - v) * bands[name][j][k] + v * bands[name][j + 1][k]);
        found[name] = { value, error };
      } else found[name] = interpolated(numbers[name], place(dampings, damping), place(kappas, kappa));
    }
    return found;
  }

  return { at };
})();
