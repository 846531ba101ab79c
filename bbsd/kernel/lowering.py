"""From numba's form of a kernel to LLVM's instructions, with values where numba has places on the stack.

Numba gives a place on the stack to every variable that several blocks use, to every array whose element is read, and
to every call; and every call gets branches for the case that it raises. LLVM finds out that none of this is needed,
in a time that grows with the number of places times the number of blocks: for a long kernel in minutes.
A kernel's variables are numbers and views of memory that nothing has to release, assigned before they are used, and
the functions that it calls do not raise.
"""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any, NamedTuple

from numba.core import cgutils, ir, types
from numba.core.analysis import compute_cfg_from_blocks, compute_use_defs
from numba.core.compiler_machinery import register_pass
from numba.core.lowering import Lower
from numba.core.typed_passes import BaseNativeLowering
from numba.np.arrayobj import basic_indexing, load_item, store_item

from bbsd.kernel.intrinsics import CompiledFunction

if TYPE_CHECKING:
    from llvmlite import ir as llvm
    from numba.core.typing.templates import Signature


class _Parts(NamedTuple):
    """The parts of an array that say where an element is."""

    data: llvm.Value
    shape: llvm.Value
    strides: llvm.Value
    itemsize: llvm.Value


class KernelLower(Lower):
    """Numba's lowering, for kernels."""

    def _find_singly_assigned_variable(self) -> None:
        """Find the variables that are values, not places: on every way to a use there is the same assignment."""
        blocks = self.func_ir.blocks
        assigned = Counter(
            statement.target.name for block in blocks.values() for statement in block.find_insts(ir.Assign)
        )
        self._singly_assigned_vars = assigned.keys() - _places(blocks, assigned)
        self._blk_local_varmap: dict[str, llvm.Value] = {}

    def storevar(self, value: llvm.Value, name: str, argidx: int | None = None) -> None:  # noqa: ARG002
        """Assign a variable; what it held needs no release."""
        if name in self._singly_assigned_vars:
            self._blk_local_varmap[name] = value
        else:
            self.builder.store(value, self.getvar(name))

    def delvar(self, name: str) -> None:
        """End a variable: there is nothing to do."""

    def lower_getitem(
        self, resty: types.Type, expr: ir.Expr, value: ir.Var, index: ir.Var, signature: Signature
    ) -> llvm.Value:
        """Read an element of an array."""
        if not _is_element(signature):
            return super().lower_getitem(resty, expr, value, index, signature)
        array, place = self._place(value, index, signature)
        element = load_item(self.context, self.builder, array, place)
        return self.context.cast(self.builder, element, signature.return_type, resty)

    def lower_setitem(
        self, target_var: ir.Var, index_var: ir.Var, value_var: ir.Var, signature: Signature
    ) -> None:
        """Write an element of an array."""
        if not _is_element(signature):
            super().lower_setitem(target_var, index_var, value_var, signature)
            return
        array, place = self._place(target_var, index_var, signature)
        value = self.loadvar(value_var.name)
        element = self.context.cast(self.builder, value, self.typeof(value_var.name), array.dtype)
        store_item(self.context, self.builder, array, element, place)

    def _place(self, array: ir.Var, index: ir.Var, signature: Signature) -> tuple[types.Array, llvm.Value]:
        """Return an array's type and the address of an element."""
        context, builder, array_type = self.context, self.builder, self.typeof(array.name)
        model, value = context.data_model_manager[array_type], self.loadvar(array.name)
        parts = _Parts(*(model.get(builder, value, name) for name in _Parts._fields))
        index_type: Any = signature.args[1]
        indices = context.cast(builder, self.loadvar(index.name), self.typeof(index.name), index_type)
        if isinstance(index_type, types.Tuple | types.UniTuple):
            index_types, indices = index_type.types, cgutils.unpack_tuple(builder, indices)
        else:
            index_types, indices = (index_type,), (indices,)
        checked = context.enable_boundscheck
        place, _, _ = basic_indexing(
            context, builder, array_type, parts, index_types, indices, boundscheck=checked
        )
        return array_type, place

    def _lower_call_normal(self, fnty: types.Type, expr: ir.Expr, signature: Signature) -> llvm.Value:
        """Call a function; none of the library raises."""
        if not isinstance(fnty, CompiledFunction):
            return super()._lower_call_normal(fnty, expr, signature)
        function: Any = fnty.dispatcher
        compiled = function.overloads[signature.args]
        arguments = self.fold_call_args(fnty, signature, expr.args, expr.vararg, expr.kws)
        self.context.add_linking_libs([compiled.library])
        _, result = self.context.call_internal_no_propagate(
            self.builder, compiled.fndesc, signature, arguments
        )
        return result


def _is_element(signature: Signature) -> bool:
    """Return whether whole numbers say which element of an array is read or written."""
    array: Any
    index: Any
    array, index, *_ = signature.args
    indices = index.types if isinstance(index, types.Tuple | types.UniTuple) else (index,)
    return (
        isinstance(array, types.Array)
        and len(indices) == array.ndim
        and all(isinstance(each, types.Integer) for each in indices)
    )


def _places(blocks: dict[int, ir.Block], assigned: Counter[str]) -> set[str]:
    """Return the variables that do not have the same assignment on every way to a use."""
    defined = compute_use_defs(blocks).defmap
    dominators = compute_cfg_from_blocks(blocks).dominators()
    homes = {name: label for label, names in defined.items() for name in names}
    return {
        name
        for label, names in compute_use_defs(blocks).usemap.items()
        for name in names
        if name in homes and (assigned[name] > 1 or homes[name] not in dominators[label])
    }


@register_pass(mutates_CFG=True, analysis_only=False)
class KernelLowering(BaseNativeLowering):
    """The pass that lowers a kernel."""

    _name = "kernel_lowering"  # type: ignore[assignment]  # numba has no types

    @property
    def lowering_class(self) -> type[KernelLower]:
        """The class that lowers a function."""
        return KernelLower
