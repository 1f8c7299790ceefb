"""Numba's way from typed code to LLVM's, with less for LLVM to clear away.

A variable that is used beyond the block that assigns it gets a place in memory: a named tuple of thirty arrays is then
read as a whole, two hundred numbers, wherever one of its fields is named, and wiped where it is last used. LLVM finds
out that none of this is needed, but in time. Where no references are counted a variable that is assigned once needs no
place: its value is known wherever its assignment comes first. And a field of a tuple is what was put there: it need not
be taken out again, nor the tuple be put together where that was all.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from functools import cache
from inspect import signature
from typing import Any

__all__ = ["plain"]

METHODS = {
    "_find_singly_assigned_variable": ["self"],
    "storevar": ["self", "value", "name", "argidx"],
    "delvar": ["self", "name"],
    "loadvar": ["self", "name"],
    "_alloca_var": ["self", "name", "fetype"],
    "setup_function": ["self", "fndesc"],
    "post_lower": ["self"],
}
KEPT = {"_singly_assigned_vars", "_blk_local_varmap"}


@cache
def plain(native: Any) -> Any:
    """Numba's pass ``native`` to LLVM's code, without places for what needs none, for functions in which no references
    are counted; the same pass of a numba that is built otherwise."""
    try:
        from llvmlite.ir import IRBuilder
        from llvmlite.ir.instructions import InsertValue, PhiInstr
        from numba.core import ir, lowering
        from numba.core.analysis import compute_cfg_from_blocks, compute_use_defs, must_use_alloca
        from numba.core.compiler_machinery import register_pass

        known: Any = lowering.Lower
        if any(list(signature(getattr(known, name)).parameters) != words for name, words in METHODS.items()):
            return native
        if not {*known.storevar.__code__.co_names} >= KEPT:
            return native
    except (ImportError, AttributeError):
        return native

    class Builder(IRBuilder):
        """Takes out of a tuple what was put in."""

        def extract_value(self, agg: Any, idx: Any, name: str = "") -> Any:
            path = list(idx) if isinstance(idx, tuple | list) else [idx]
            while isinstance(agg, InsertValue) and len(agg.indices) == 1:
                if agg.indices[0] != path[0]:
                    agg = agg.aggregate
                    continue
                agg, path = agg.value, path[1:]
                if not path:
                    return agg
            return super().extract_value(agg, path, name)

    class PlainLower(known):
        """For functions in which no references are counted."""

        def setup_function(self, fndesc: Any) -> None:
            super().setup_function(fndesc)
            self.builder = Builder(self.entry_block)
            self.call_helper = self.call_conv.init_call_helper(self.builder)

        def post_lower(self) -> None:
            """Leave out tuples of arguments that nothing asks for as a whole."""
            super().post_lower()
            uses = Counter(
                id(operand)
                for block in self.function.blocks
                for instruction in block.instructions
                for operand in (
                    [value for value, _ in instruction.incomings]
                    if isinstance(instruction, PhiInstr)
                    else instruction.operands
                )
            )
            kept = []
            for instruction in reversed(self.entry_block.instructions):
                if isinstance(instruction, InsertValue) and not uses[id(instruction)]:
                    uses.subtract(map(id, instruction.operands))
                else:
                    kept.append(instruction)
            self.entry_block.instructions[:] = reversed(kept)

        def _find_singly_assigned_variable(self) -> None:
            """Numba's own, and those used in other blocks all of which come after the assignment."""
            super()._find_singly_assigned_variable()
            use_defs = compute_use_defs(self.blocks)
            assigned = Counter(s.target.name for block in self.blocks.values() for s in block.find_insts(ir.Assign))
            used = defaultdict(list)
            for place, names in use_defs.usemap.items():
                for name in names:
                    used[name].append(place)
            before = compute_cfg_from_blocks(self.blocks).dominators()
            in_memory = must_use_alloca(self.blocks)
            for place, names in use_defs.defmap.items():
                for name in names:
                    if assigned[name] == 1 and name not in in_memory:
                        if all(place < other and place in before[other] for other in used[name]):
                            self._singly_assigned_vars.add(name)

        def storevar(self, value: Any, name: str, argidx: int | None = None) -> None:
            """Without a look at what was there, of which numba would count one reference less."""
            if argidx is not None or name in self._singly_assigned_vars:
                super().storevar(value, name, argidx)
            else:
                self._alloca_var(name, self.typeof(name))
                self.builder.store(value, self.getvar(name))

        def delvar(self, name: str) -> None:
            """Nothing is to be freed."""

    @register_pass(mutates_CFG=True, analysis_only=False)
    class PlainLowering(native):
        """By a :class:`PlainLower`."""

        _name = "plain_native_lowering"

        @property
        def lowering_class(self) -> Any:
            return PlainLower

    return PlainLowering
