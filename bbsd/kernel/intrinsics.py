"""What compiled code uses for `kernel.primitives` and `kernel.memory`: few instructions, the same bits, no branch.

Told to numba by its low-level interface, types and instructions apart. An overload would compile a function of its own
for each primitive and each combination of types, which is a third of the time that a new kernel takes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from llvmlite import ir
from numba import boolean, float64, int64, types, uint64
from numba.core.imputils import impl_ret_borrowed
from numba.core.typing.templates import infer_global, signature
from numba.extending import lower_builtin, models, register_model, type_callable
from numba.np.arrayobj import make_array

from bbsd.kernel import memory, primitives

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numba.core.base import BaseContext
    from numba.core.dispatcher import Dispatcher
    from numba.core.typing.context import Context
    from numba.core.typing.templates import Signature

    Function = Callable[..., Any]
    Typer = Callable[..., Signature]
    Emit = Callable[..., ir.Value]
    """Emits a function's instructions, given the builder, the signature and the arguments' values."""

FLOAT = ir.DoubleType()
WORD = ir.IntType(64)


def register() -> None:
    """Make the primitives callable in compiled code."""
    for function, found, emit in FIXED:
        _tell(function, FIXED_TYPES[len(found.args)](found), emit)
    _tell(primitives.word_of, _word_type, lambda _builder, _found, number: number)
    _tell(primitives.select, _select_type, lambda builder, _found, *values: builder.select(*values))
    _tell(primitives.minimum, _same_type, _chosen("<"))
    _tell(primitives.maximum, _same_type, _chosen(">"))
    _tell(primitives.maximum_where, _where_type, _maximum_where)
    for seen, dtype in ((memory.as_words, uint64), (memory.as_integers, int64)):
        type_callable(seen)(_view_type(dtype))
        lower_builtin(seen, types.Array)(_view)
    type_callable(memory.part)(_part_type)
    lower_builtin(memory.part, types.Array, types.Any, types.Any)(_view)


class _Offered(types.Dispatcher):
    """What numba takes a function of the library for: compiled already, whatever literals it is called with."""

    def get_call_type(
        self, context: Context, args: Sequence[types.Type], kws: Mapping[str, types.Type]
    ) -> Signature | None:
        return super().get_call_type(context, tuple(map(types.unliteral, args)), kws)


register_model(_Offered)(models.OpaqueModel)


def offer(function: Function, compiled: Dispatcher) -> None:
    """Make a function callable in compiled code as what it was compiled to, which the caller has to keep."""
    infer_global(function, _Offered(compiled))


def _tell(function: Function, typed: Callable[[Context], Typer], emit: Emit) -> None:
    def lowered(
        _context: Context, builder: ir.IRBuilder, found: Signature, values: tuple[ir.Value, ...]
    ) -> ir.Value:
        return emit(builder, found, *values)

    type_callable(function)(typed)
    lower_builtin(function, types.VarArg(types.Any))(lowered)


# --- Types: numba casts the arguments to those of the signature


def _unary(found: Signature) -> Callable[[Context], Typer]:
    return lambda _context: lambda _x: found


def _binary(found: Signature) -> Callable[[Context], Typer]:
    return lambda _context: lambda _a, _b: found


def _ternary(found: Signature) -> Callable[[Context], Typer]:
    return lambda _context: lambda _a, _b, _c: found


FIXED_TYPES = {1: _unary, 2: _binary, 3: _ternary}


def _word_type(_context: Context) -> Typer:
    return lambda number: signature(uint64, uint64 if types.unliteral(number) == uint64 else int64)


def _same_type(context: Context) -> Typer:
    def typed(a: types.Type, b: types.Type) -> Signature:
        value = context.unify_types(types.unliteral(a), types.unliteral(b))
        return signature(value, value, value)

    return typed


def _where_type(context: Context) -> Typer:
    def typed(value: types.Type, _condition: types.Type, other: types.Type) -> Signature:
        found = context.unify_types(types.unliteral(value), types.unliteral(other))
        return signature(found, found, boolean, found)

    return typed


def _select_type(context: Context) -> Typer:
    def typed(_condition: types.Type, then: types.Type, otherwise: types.Type) -> Signature:
        value = context.unify_types(types.unliteral(then), types.unliteral(otherwise))
        return signature(value, boolean, value, value)

    return typed


def _view_type(dtype: types.Type) -> Callable[[Context], Typer]:
    return lambda _context: lambda array: signature(array.copy(dtype=dtype), array)


def _part_type(_context: Context) -> Typer:
    return lambda array, _first, _size: signature(array, array, int64, int64)


# --- Instructions


def _llvm(name: str, n_arguments: int = 1) -> Emit:
    """Emits a call of LLVM's intrinsic function of that name, all of whose arguments are floats."""
    called = ir.FunctionType(FLOAT, [FLOAT] * n_arguments)
    return lambda builder, _found, *values: builder.call(
        builder.module.declare_intrinsic(name, [FLOAT], called), values
    )


def _chosen(comparison: str) -> Emit:
    """Emits the choice of the second value where it compares so with the first, else of the first."""

    def emit(builder: ir.IRBuilder, found: Signature, a: ir.Value, b: ir.Value) -> ir.Value:
        if found.return_type == float64:
            return builder.select(builder.fcmp_ordered(comparison, b, a), b, a)
        compare = builder.icmp_unsigned if found.return_type == uint64 else builder.icmp_signed
        return builder.select(compare(comparison, b, a), b, a)

    return emit


def _blended(builder: ir.IRBuilder, condition: ir.Value, then: ir.Value, otherwise: ir.Value) -> ir.Value:
    """`otherwise ^ ((then ^ otherwise) & mask)`."""
    mask, one, other = (
        builder.sext(condition, WORD),
        builder.bitcast(then, WORD),
        builder.bitcast(otherwise, WORD),
    )
    return builder.bitcast(builder.xor(other, builder.and_(builder.xor(one, other), mask)), FLOAT)


def _maximum_where(
    builder: ir.IRBuilder, found: Signature, highest: ir.Value, condition: ir.Value, other: ir.Value
) -> ir.Value:
    return builder.select(condition, _chosen(">")(builder, found, highest, other), highest)


def _view(
    context: BaseContext, builder: ir.IRBuilder, found: Signature, values: tuple[ir.Value, ...]
) -> ir.Value:
    """The same memory as an array of other elements, or from a first element on so many."""
    array, *part = values
    seen = make_array(found.args[0])(context, builder, array)
    view = make_array(found.return_type)(context, builder)
    for name in ("meminfo", "parent", "nitems", "itemsize", "shape", "strides"):
        setattr(view, name, getattr(seen, name))
    data = seen.data
    if part:
        first, view.nitems = part
        view.shape = builder.insert_value(view.shape, view.nitems, 0)
        data = builder.gep(data, [first])
    view.data = builder.bitcast(data, view.data.type)
    value = view._getvalue()  # noqa: SLF001 - as numba's own documentation does it
    return impl_ret_borrowed(context, builder, found.return_type, value)


FIXED: tuple[tuple[Function, Signature, Emit], ...] = (
    (primitives.bits_of, int64(float64), lambda builder, _found, x: builder.bitcast(x, WORD)),
    (primitives.float_of, float64(int64), lambda builder, _found, bits: builder.bitcast(bits, FLOAT)),
    (
        primitives.add_where,
        float64(float64, boolean, float64),
        lambda builder, _found, total, condition, term: builder.select(
            condition, builder.fadd(total, term), total
        ),
    ),
    (
        primitives.blend,
        float64(boolean, float64, float64),
        lambda builder, _found, *values: _blended(builder, *values),
    ),
    (primitives.cell_of, int64(boolean), lambda builder, _found, truth: builder.zext(truth, WORD)),
    (primitives.copysign, float64(float64, float64), _llvm("llvm.copysign", 2)),
    (primitives.divide, float64(float64, float64), lambda builder, _found, *values: builder.fdiv(*values)),
    (primitives.sqrt, float64(float64), _llvm("llvm.sqrt")),
    (primitives.round_half_even, float64(float64), _llvm("llvm.rint")),
    (primitives.floor, float64(float64), _llvm("llvm.floor")),
    (primitives.ceil, float64(float64), _llvm("llvm.ceil")),
)
"""Primitives of one signature."""
