"""Arithmetic without subnormal numbers.

Ahead of the waves, deflections and velocities fade below 2.2e-308, where numbers lose digits one by one before they
reach zero. Many processors compute with such *subnormal* numbers a hundred times more slowly. The x86 and ARM
processors can take them as zero (FTZ and DAZ bits of the control register); this changes no result above 2.2e-308.
"""

from __future__ import annotations

import platform
from typing import Any

from llvmlite import ir
from numba import config, types
from numba.core import cgutils
from numba.extending import intrinsic

from hermite_fe.kernels.jit import compiled_in_place

__all__ = ["count_subnormals", "flush", "restore"]

SMALLEST = 2.2250738585072014e-308  # the smallest normal number
MACHINE = platform.machine().lower()
X86, ARM = MACHINE in ("x86_64", "amd64", "i386", "i686"), MACHINE in ("aarch64", "arm64")
FLUSH = 0x8040 if X86 else 1 << 24  # FTZ | DAZ of MXCSR; FZ of FPCR
INTERPRETED = bool(config.DISABLE_JIT)  # type: ignore[attr-defined]  # plain Python reaches no control register


@intrinsic
def control(context: Any) -> Any:
    """The processor's floating-point control register (0 where it is not known)."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        if X86:
            place = cgutils.alloca_once(builder, ir.IntType(32))
            kind = ir.FunctionType(ir.VoidType(), [ir.IntType(8).as_pointer()])
            function = cgutils.get_or_insert_function(builder.module, kind, "llvm.x86.sse.stmxcsr")
            builder.call(function, [builder.bitcast(place, ir.IntType(8).as_pointer())])
            return builder.zext(builder.load(place), ir.IntType(64))
        if ARM:
            kind = ir.FunctionType(ir.IntType(64), [])
            function = cgutils.get_or_insert_function(builder.module, kind, "llvm.aarch64.get.fpcr")
            return builder.call(function, [])
        return ir.Constant(ir.IntType(64), 0)

    return types.int64(), generate


@intrinsic
def set_control(context: Any, value: Any) -> Any:
    """Set that register."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        if X86:
            place = cgutils.alloca_once(builder, ir.IntType(32))
            builder.store(builder.trunc(arguments[0], ir.IntType(32)), place)
            kind = ir.FunctionType(ir.VoidType(), [ir.IntType(8).as_pointer()])
            function = cgutils.get_or_insert_function(builder.module, kind, "llvm.x86.sse.ldmxcsr")
            builder.call(function, [builder.bitcast(place, ir.IntType(8).as_pointer())])
        elif ARM:
            kind = ir.FunctionType(ir.VoidType(), [ir.IntType(64)])
            function = cgutils.get_or_insert_function(builder.module, kind, "llvm.aarch64.set.fpcr")
            builder.call(function, [arguments[0]])
        return context.get_dummy_value()

    return types.void(types.int64), generate


@compiled_in_place
def flush() -> int:
    """Take subnormal numbers as zero and make none from now on, in this thread; returns what :func:`restore` needs."""
    if INTERPRETED:
        return 0
    before: int = control()  # type: ignore[call-arg]
    set_control(before | FLUSH)
    return before


@compiled_in_place
def restore(before: int) -> None:
    """Compute as before :func:`flush`."""
    if not INTERPRETED:
        set_control(before)  # type: ignore[call-arg]


@compiled_in_place
def count_subnormals(x):  # type: ignore[no-untyped-def]
    """How many of the numbers of ``x`` (any,) are subnormal (0 between :func:`flush` and :func:`restore`)."""
    count = 0
    for value in x:
        if value != 0.0 and abs(value) < SMALLEST:
            count += 1
    return count
