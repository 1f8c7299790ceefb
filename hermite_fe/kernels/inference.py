"""Numba's type inference, faster by what it has found before.

To find the type of ``a + b`` numba tries the implementations of ``+`` for strings, lists, sets … before those for
numbers, and again at every place where two such numbers are added; at each trial it compares all options of the
compiler. That was a third of the time in which the kernels of a first run are compiled. :func:`remember` keeps the
answers; they are the same.
"""

from __future__ import annotations

from functools import wraps
from typing import Any

from numba.core.targetconfig import ConfigStack, TargetConfig
from numba.core.types.functions import BaseFunction

__all__ = ["remember"]


def remember() -> None:
    """Let numba find each type once, for all that this process compiles; calling it again changes nothing."""
    if not hasattr(BaseFunction.get_call_type, "__wrapped__"):
        functions: Any = BaseFunction
        functions.get_call_type = _remembered(BaseFunction.get_call_type)
        options: Any = TargetConfig
        options.__eq__, options.__hash__ = _quickly_equal(TargetConfig.__eq__), lambda self: len(self.options)


def _quickly_equal(equal: Any) -> Any:
    """Options that are set alike are equal: only others are compared one by one."""

    @wraps(equal)
    def compare(self: Any, other: Any) -> Any:
        return (type(self) is type(other) and self._values == other._values) or equal(self, other)

    return compare


def _remembered(get_call_type: Any) -> Any:
    """The signature of a call and what implements it, by function, types of the arguments and compiler's options."""
    known: dict[Any, tuple[Any, Any]] = {}

    @wraps(get_call_type)
    def found(self: Any, context: Any, arguments: Any, names: dict[str, Any]) -> Any:
        call = self, context, tuple(arguments), tuple(names.items()), ConfigStack.top_or_none()
        if call not in known:
            signature = get_call_type(self, context, arguments, names)
            known[call] = signature, self._impl_keys[signature.args]
        signature, self._impl_keys[signature.args] = known[call]
        return signature

    return found
