"""How the kernels of this package are compiled: cached on disk, so that a second start pays nothing.

The first start pays for every line and every array of every signature. So a kernel that others call is compiled for
them without a way in from Python, and made machine code once, with the kernel that Python calls, not at every level in
between; a long one stays a function of its own there; none has a way in from C; where no array is made no references
are counted, and what numba does for closures and the like is left out; types that have been found are kept
(:mod:`.inference`), variables are not (:mod:`.lowering`); and Python does not look for cycles meanwhile. A first
simulation takes about 10 s of processor time so, and twice that where long kernels are written into others, types are
looked for anew and so on. A kernel that Python calls too is compiled a second time for it.
(Two processes side by side were 5 % faster, on two cores that share one memory.)
"""

from __future__ import annotations

import gc
import hashlib
import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any, TypeVar, cast

import numba
from numba.core.caching import CompileResultCacheImpl, FunctionCache, IndexDataCacheFile
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, DefaultPassBuilder
from numba.core.compiler_machinery import PassManager
from numba.core.runtime.nrt import rtsys

from hermite_fe.kernels import lowering
from hermite_fe.kernels.inference import remember

__all__ = ["compiled", "compiled_apart", "compiled_in_place", "compiled_maxima", "compiled_sums"]

Function = TypeVar("Function", bound=Callable[..., Any])


def sources() -> str:
    """Digest of all modules of this package."""
    texts = (path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py")))
    return hashlib.sha256(b"\0".join(texts)).hexdigest()


SOURCES = sources()


class KernelFiles(IndexDataCacheFile):
    """Kernels on disk, each file marked with what it was compiled from.

    Numba marks the index alone, and writes it first: where the kernel itself then cannot be written, or a reader comes
    in between, a fresh index leads to the code of the version before.
    """

    def load(self, key: Any) -> Any:
        found = super().load(key)
        return found[1] if found is not None and found[0] == self._mark(key) else None

    def save(self, key: Any, data: Any) -> None:
        super().save(key, (self._mark(key), data))

    def _mark(self, key: Any) -> tuple[Any, ...]:
        return self._source_stamp, self._version, key

    def _load_index(self) -> Any:
        try:
            return super()._load_index()
        except Exception:  # a file that lost its end in a power cut is pickled nonsense
            return {}


class KernelCache(FunctionCache):
    """Numba's cache, stale as soon as any module of the package changes.

    Numba itself looks at the kernel's own file only, and would go on running what that kernel had called before
    (``theta`` with the ``pivoting`` of the version before an upgrade). What cannot be kept or read is compiled anew: it
    costs time, not the run.
    """

    suffix = ""

    def __init__(self, kernel: Callable[..., Any]) -> None:
        super().__init__(kernel)
        self._cache_file = KernelFiles(
            cache_path=self._cache_path, filename_base=self._impl.filename_base + self.suffix, source_stamp=SOURCES
        )

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        """What is found needs no more of numba than its runtime: numba itself would import all that it can compile."""
        rtsys.initialize(target_context)
        found = None
        with suppress(Exception):  # a file that lost its end, or that cannot be opened
            found = self._load_overload(signature, target_context)
        if found is None:
            _say_once()
        return found

    def save_overload(self, signature: Any, data: Any) -> None:
        with suppress(OSError):  # the disk is full
            super().save_overload(signature, data)


@cache
def _say_once() -> None:
    """To the logger that the command shows on standard error."""
    logging.getLogger("bent_beam").info("compiling, as always on a new machine or after an update: about 10 seconds")


class PartLibrary(JITCodeLibrary):
    """The code of a kernel for those that call it: neither optimised nor made machine code, which is done once for all
    that a kernel calls where Python calls it, not once more at every level in between."""

    def _optimize_functions(self, module: Any) -> None:
        """Made smaller only: a third of the time."""
        level, numba.config.OPT = numba.config.OPT, 1  # type: ignore[attr-defined]
        try:
            super()._optimize_functions(module)
        finally:
            numba.config.OPT = level  # type: ignore[attr-defined]

    def _optimize_final_module(self) -> None:
        pass

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True

    @property
    def codegen(self) -> Any:
        """Where numba would leave what the code needs to raise errors; it has no address yet (:func:`kernel`)."""
        return SimpleNamespace(set_env=lambda name, environment: None)

    def get_pointer_to_function(self, name: str) -> int:
        self._ensure_finalized()
        return 0

    def serialize_using_object_code(self) -> Any:
        return self.serialize_using_bitcode()


class ApartLibrary(PartLibrary):
    """The code of a long kernel, which is not written into those that call it: so much less to optimise."""

    def add_ir_module(self, ir_module: Any) -> None:
        for function in ir_module.functions:
            if not function.is_declaration and "alwaysinline" not in function.attributes:
                function.attributes.add("noinline")
        super().add_ir_module(ir_module)


class PartCacheImpl(CompileResultCacheImpl):
    """What is loaded is a :class:`PartLibrary` again: as machine code it would run in place of the optimised one."""

    def rebuild(self, target_context: Any, payload: Any) -> Any:
        codegen = target_context.codegen()
        codegen._library_class = PartLibrary
        try:
            return super().rebuild(target_context, payload)
        finally:
            del codegen._library_class


class PartCache(KernelCache):
    """Where kernels for other kernels are kept."""

    _impl_class = PartCacheImpl  # type: ignore[assignment]
    suffix = ".part"


@contextmanager
def _cycles_kept() -> Iterator[None]:
    """Without looking for cycles among what is made in here, almost all of which stays: a tenth of a compilation."""
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()


class KernelCompiler(Compiler):
    """Numba's compiler."""

    def compile_extra(self, function: Any) -> Any:
        with _cycles_kept():
            return super().compile_extra(function)


class PartCompiler(KernelCompiler):
    """Numba's compiler, into a :class:`PartLibrary`."""

    library: type[PartLibrary] = PartLibrary

    def __init__(self, typing: Any, target: Any, library: Any, *rest: Any) -> None:
        super().__init__(typing, target, self.library(target.codegen(), "part"), *rest)


class ApartCompiler(PartCompiler):
    """Numba's compiler, into an :class:`ApartLibrary`."""

    library = ApartLibrary


NOT_IN_PLAIN_KERNELS = {
    *("WithLifting", "InlineClosureLikes", "MakeFunctionToJitFunction", "RewriteDynamicRaises"),
    *("FindLiterallyCalls", "LiteralUnroll", "LiteralPropagationSubPipelinePass", "DeadBranchPrune"),
    *("InlineInlinables", "InlineOverloads", "NopythonRewrites"),
}
"""Numba's passes for closures and comprehensions, ``with``, what errors say, ``literal_unroll``, branches on ``None``,
functions to be inlined before their types are known, and sums and products of whole arrays."""


class Plain:
    """A compiler of kernels that loop over numbers: without passes for what is not in them (which would not compile).
    Such passes take a tenth of the time."""

    def define_pipelines(self) -> list[PassManager]:
        plain = PassManager("plain kernel")
        for kind, description in DefaultPassBuilder.define_nopython_pipeline(self.state).passes:  # type: ignore[attr-defined]
            if kind.__name__ == "NativeLowering":
                kind = lowering.plain(kind)
            if kind.__name__ not in NOT_IN_PLAIN_KERNELS:
                plain.add_pass(kind, description)
        plain.finalize()
        return [plain]


class PlainCompiler(Plain, KernelCompiler):
    """For Python."""


class PlainPartCompiler(Plain, PartCompiler):
    """For other kernels."""


class PlainApartCompiler(Plain, ApartCompiler):
    """For other kernels, long."""


def kernel(
    function: Function,
    compiler: type[Compiler] = KernelCompiler,
    part_compiler: type[Compiler] = PartCompiler,
    **options: Any,
) -> Function:
    """``function`` compiled at its first call or loaded; as it is under ``NUMBA_DISABLE_JIT=1``, to step through it.

    Kernels call another compilation of it than Python does, one without a way in from Python.
    """
    if numba.config.DISABLE_JIT:  # type: ignore[attr-defined]  # set as numba is imported
        return function
    remember()
    options = {"error_model": "numpy", "no_cfunc_wrapper": True, **options}
    njit: Any = numba.njit  # whose types do not know all options
    called = njit(pipeline_class=compiler, **options)(function)

    @cache
    def part() -> Any:
        """Made when another kernel is compiled that calls this one."""
        made = njit(no_cpython_wrapper=True, pipeline_class=part_compiler, **options)(function)
        with suppress(RuntimeError):
            made._cache = PartCache(function)
        return made

    def template_without_literals(arguments: tuple[Any, ...], names: dict[str, Any]) -> Any:
        """Numba would compile a kernel once more for each number that a call writes out, as ``first = 0``."""
        return part().get_call_template(tuple(numba.types.unliteral(a) for a in arguments), names)

    add_overload = called.add_overload

    def add_with_parts(result: Any) -> None:
        """What the parts of a kernel need to raise errors is left where their code now is."""
        for environment in result._find_referenced_environments():
            result.library.codegen.set_env(environment.env_name, environment)
        add_overload(result)

    called.add_overload = add_with_parts
    called.get_call_template = template_without_literals
    called.get_overload = lambda signature: part().get_overload(signature)
    with suppress(RuntimeError):  # neither this folder nor the user's can be written: compiled anew at every start
        called._cache = KernelCache(function)
    return cast(Function, called)


def compiled(function: Function) -> Function:
    """Compile with multiply–add contraction only: the order of sums is kept, as compensated sums need."""
    return kernel(function, fastmath={"contract"}, _nrt=True)


def compiled_in_place(function: Function) -> Function:
    """As :func:`compiled`, for a kernel that makes no arrays (views of those that it is given are none) and loops over
    numbers: no closures, no comprehensions, no arithmetic with whole arrays."""
    return kernel(function, PlainCompiler, PlainPartCompiler, fastmath={"contract"}, _nrt=False)


def compiled_apart(function: Function) -> Function:
    """As :func:`compiled_in_place`, for a long kernel that is called a few times a step: it stays a function."""
    return kernel(function, PlainCompiler, PlainApartCompiler, fastmath={"contract"}, _nrt=False)


def compiled_sums(function: Function) -> Function:
    """Compile with sums reordered for speed, for kernels to which their order is nothing and which are else as those of
    :func:`compiled_in_place`."""
    return kernel(function, PlainCompiler, PlainPartCompiler, fastmath={"contract", "reassoc"}, _nrt=False)


def compiled_maxima(function: Function) -> Function:
    """As :func:`compiled_sums`, for largest numbers: what is none (NaN) may count for nothing."""
    fastmath = {"contract", "reassoc", "nnan", "nsz"}
    return kernel(function, PlainCompiler, PlainPartCompiler, fastmath=fastmath, _nrt=False)
