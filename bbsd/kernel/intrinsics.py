"""The machine instructions of `kernel.primitives` and `kernel.memory` in compiled code: few, without branches.

They are registered by numba's low-level interface, types and instructions apart. An overload would compile a function
of its own for each primitive and each combination of types, a third of the time that a new kernel takes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from llvmlite import ir
from numba import boolean, float64, int64, types, uint64
from numba.core.imputils import impl_ret_borrowed
from numba.core.typing.templates import infer_global, signature
from numba.extending import lower_builtin, models, register_model, type_callable

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
    """A function that emits instructions, given the builder, the signature and the values of the arguments."""

FLOAT = ir.DoubleType()
WORD = ir.IntType(64)


def register() -> None:
    """Make the primitives callable in compiled code."""
    for function, sig, emit in FIXED:
        _register_primitive(function, FIXED_TYPES[len(sig.args)](sig), emit)
    _register_primitive(primitives.word_of, _word_type, lambda _builder, _sig, number: number)
    _register_primitive(
        primitives.select, _select_type, lambda builder, _sig, *values: builder.select(*values)
    )
    _register_primitive(primitives.minimum, _same_type, _chosen("<"))
    _register_primitive(primitives.maximum, _same_type, _chosen(">"))
    _register_primitive(primitives.maximum_where, _where_type, _maximum_where)
    for view, dtype in ((memory.as_words, uint64), (memory.as_integers, int64)):
        type_callable(view)(_view_type(dtype))
        lower_builtin(view, types.Array)(_view)
    type_callable(memory.part)(_part_type)
    lower_builtin(memory.part, types.Array, types.Any, types.Any)(_view)


class CompiledFunction(types.Dispatcher):
    """The type of a library function: numba need not compile it again for the literals in a call."""

    def get_call_type(
        self, context: Context, args: Sequence[types.Type], kws: Mapping[str, types.Type]
    ) -> Signature | None:
        """Return the signature of a call with arguments of these types."""
        return super().get_call_type(context, tuple(map(types.unliteral, args)), kws)


register_model(CompiledFunction)(models.OpaqueModel)


def offer(function: Function, compiled: Dispatcher) -> None:
    """Make a library function callable in compiled code by its compiled form, which the caller must keep."""
    infer_global(function, CompiledFunction(compiled))


def _register_primitive(function: Function, typed: Callable[[Context], Typer], emit: Emit) -> None:
    def lowered(
        _context: Context, builder: ir.IRBuilder, sig: Signature, values: tuple[ir.Value, ...]
    ) -> ir.Value:
        return emit(builder, sig, *values)

    type_callable(function)(typed)
    lower_builtin(function, types.VarArg(types.Any))(lowered)


# --- Types: numba casts the arguments to those of the signature


def _unary(sig: Signature) -> Callable[[Context], Typer]:
    return lambda _context: lambda _x: sig


def _binary(sig: Signature) -> Callable[[Context], Typer]:
    return lambda _context: lambda _a, _b: sig


def _ternary(sig: Signature) -> Callable[[Context], Typer]:
    return lambda _context: lambda _a, _b, _c: sig


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
        number = context.unify_types(types.unliteral(value), types.unliteral(other))
        return signature(number, number, boolean, number)

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
    """Return what emits a call of an intrinsic function of LLVM, all of whose arguments are floats."""
    called = ir.FunctionType(FLOAT, [FLOAT] * n_arguments)
    return lambda builder, _sig, *values: builder.call(
        builder.module.declare_intrinsic(name, [FLOAT], called), values
    )


def _chosen(comparison: str) -> Emit:
    """Return what emits the choice of the second value where it compares so with the first, else of the first."""

    def emit(builder: ir.IRBuilder, sig: Signature, a: ir.Value, b: ir.Value) -> ir.Value:
        if sig.return_type == float64:
            return builder.select(builder.fcmp_ordered(comparison, b, a), b, a)
        compare = builder.icmp_unsigned if sig.return_type == uint64 else builder.icmp_signed
        return builder.select(compare(comparison, b, a), b, a)

    return emit


def _blended(builder: ir.IRBuilder, condition: ir.Value, then: ir.Value, otherwise: ir.Value) -> ir.Value:
    """Emit `otherwise ^ ((then ^ otherwise) & mask)`."""
    mask, one, other = (
        builder.sext(condition, WORD),
        builder.bitcast(then, WORD),
        builder.bitcast(otherwise, WORD),
    )
    return builder.bitcast(builder.xor(other, builder.and_(builder.xor(one, other), mask)), FLOAT)


def _maximum_where(
    builder: ir.IRBuilder, sig: Signature, highest: ir.Value, condition: ir.Value, other: ir.Value
) -> ir.Value:
    return builder.select(condition, _chosen(">")(builder, sig, highest, other), highest)


def _view(
    context: BaseContext, builder: ir.IRBuilder, sig: Signature, values: tuple[ir.Value, ...]
) -> ir.Value:
    """Emit a view of an array: the same memory with other elements, or a number of elements from a first one on."""
    array, *part = values
    source, result = (context.data_model_manager[each] for each in (sig.args[0], sig.return_type))
    view = ir.Constant(result.get_value_type(), ir.Undefined)
    for name in ("meminfo", "parent", "nitems", "itemsize", "data", "shape", "strides"):
        value = source.get(builder, array, name)
        match name, part:
            case "nitems", (_, size):
                value = size
            case "shape", (_, size):
                value = builder.insert_value(value, size, 0)
            case "data", (first, _):
                value = builder.gep(value, [first])
            case "data", ():
                value = builder.bitcast(value, context.get_data_type(sig.return_type.dtype).as_pointer())
        view = result.set(builder, view, value, name)
    return impl_ret_borrowed(context, builder, sig.return_type, view)


FIXED: tuple[tuple[Function, Signature, Emit], ...] = (
    (primitives.bits_of, int64(float64), lambda builder, _sig, x: builder.bitcast(x, WORD)),
    (primitives.float_of, float64(int64), lambda builder, _sig, bits: builder.bitcast(bits, FLOAT)),
    (
        primitives.add_where,
        float64(float64, boolean, float64),
        lambda builder, _sig, total, condition, term: builder.select(
            condition, builder.fadd(total, term), total
        ),
    ),
    (
        primitives.blend,
        float64(boolean, float64, float64),
        lambda builder, _sig, *values: _blended(builder, *values),
    ),
    (primitives.cell_of, int64(boolean), lambda builder, _sig, truth: builder.zext(truth, WORD)),
    (primitives.copysign, float64(float64, float64), _llvm("llvm.copysign", 2)),
    (primitives.divide, float64(float64, float64), lambda builder, _sig, *values: builder.fdiv(*values)),
    (
        primitives.truncated_remainder,
        float64(float64, float64),
        lambda builder, _sig, *values: builder.frem(*values),
    ),
    (primitives.sqrt, float64(float64), _llvm("llvm.sqrt")),
    (primitives.round_half_even, float64(float64), _llvm("llvm.rint")),
    (primitives.floor, float64(float64), _llvm("llvm.floor")),
    (primitives.ceil, float64(float64), _llvm("llvm.ceil")),
)
"""The primitives that have one signature."""
