"""Numba's type inference, faster by what it has found before.

To find the type of ``a + b`` numba tries the implementations of ``+`` for strings, lists, sets … before those for
numbers, and again at every place where two such numbers are added; at each trial it compares all options of the
compiler. That was a third of the time in which the kernels of a first run are compiled. :func:`remember` keeps the
answers; they are the same.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import Any

__all__ = ["remember"]


def remember() -> None:
    """Let numba find each type once, for all that this process compiles; calling it again changes nothing.

    A numba that is built otherwise is left as it is, and compiles for longer.
    """
    try:
        from numba.core.targetconfig import ConfigStack, TargetConfig
        from numba.core.types.functions import BaseFunction

        functions: Any = BaseFunction
        options: Any = TargetConfig
        call, kept = functions.get_call_type, functions.get_impl_key.__code__.co_names
        if hasattr(call, "__wrapped__") or list(signature(call).parameters) != ["self", "context", "args", "kws"]:
            return
        if "_impl_keys" not in kept or not isinstance(options()._values, dict):
            return
        remembered = _remembered(call, ConfigStack.top_or_none)
    except (ImportError, AttributeError):
        return
    functions.get_call_type = remembered
    options.__eq__, options.__hash__ = _quickly_equal(options.__eq__), lambda self: len(self.options)


def _quickly_equal(equal: Any) -> Any:
    """Options that are set alike are equal: only others are compared one by one."""

    @wraps(equal)
    def compare(self: Any, other: Any) -> Any:
        return (type(self) is type(other) and self._values == other._values) or equal(self, other)

    return compare


def _remembered(get_call_type: Any, options: Callable[[], Any]) -> Any:
    """The signature of a call and what implements it, by function, types of the arguments and compiler's options."""
    known: dict[Any, tuple[Any, Any]] = {}

    @wraps(get_call_type)
    def remembered(self: Any, context: Any, arguments: Any, names: dict[str, Any]) -> Any:
        call = self, context, tuple(arguments), tuple(names.items()), options()
        if call not in known:
            found = get_call_type(self, context, arguments, names)
            known[call] = found, self._impl_keys[found.args]
        found, self._impl_keys[found.args] = known[call]
        return found

    return remembered
