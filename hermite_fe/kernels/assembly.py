"""Compiled assembly of Hermite beam elements into scipy's lower banded form, shape (4, 2·nodes)."""

from __future__ import annotations

from hermite_fe.kernels.jit import compiled_in_place


@compiled_in_place
def assemble(lengths, element, bands):  # type: ignore[no-untyped-def]
    """Add the element matrices ``element`` (elements, 4, 4), dofs (w₁, θ₁, w₂, θ₂), to ``bands``."""
    for e in range(lengths.size):
        for i in range(4):
            for j in range(i + 1):
                bands[i - j, 2 * e + j] += element[e, i, j]


@compiled_in_place
def assemble_load(element, load):  # type: ignore[no-untyped-def]
    """Add the element loads ``element`` (elements, 4) to ``load`` (2·nodes,)."""
    for e in range(element.shape[0]):
        for i in range(4):
            load[2 * e + i] += element[e, i]
