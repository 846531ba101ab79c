"""What compiled code uses for `kernel.primitives`: one or two instructions each, the same bits, no branch.

Told to numba by its low-level interface, types and instructions apart. An overload would compile a function of its own
for each primitive and each combination of types, which is a third of the time that a new kernel takes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from llvmlite import ir
from numba import boolean, float64, int64, types, uint64
from numba.core.typing.templates import signature
from numba.extending import lower_builtin, type_callable

from bbsd.kernel import primitives

if TYPE_CHECKING:
    from collections.abc import Callable

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
        _tell(function, _unary(found) if len(found.args) == 1 else _binary(found), emit)
    _tell(primitives.word_of, _word_type, lambda _builder, _found, number: number)
    _tell(primitives.select, _select_type, lambda builder, _found, *values: builder.select(*values))
    _tell(primitives.minimum, _same_type, _chosen("<"))
    _tell(primitives.maximum, _same_type, _chosen(">"))


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


def _word_type(_context: Context) -> Typer:
    return lambda number: signature(uint64, uint64 if types.unliteral(number) == uint64 else int64)


def _same_type(context: Context) -> Typer:
    def typed(a: types.Type, b: types.Type) -> Signature:
        value = context.unify_types(types.unliteral(a), types.unliteral(b))
        return signature(value, value, value)

    return typed


def _select_type(context: Context) -> Typer:
    def typed(_condition: types.Type, then: types.Type, otherwise: types.Type) -> Signature:
        value = context.unify_types(types.unliteral(then), types.unliteral(otherwise))
        return signature(value, boolean, value, value)

    return typed


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


FIXED: tuple[tuple[Function, Signature, Emit], ...] = (
    (primitives.bits_of, int64(float64), lambda builder, _found, x: builder.bitcast(x, WORD)),
    (primitives.float_of, float64(int64), lambda builder, _found, bits: builder.bitcast(bits, FLOAT)),
    (primitives.copysign, float64(float64, float64), _llvm("llvm.copysign", 2)),
    (primitives.divide, float64(float64, float64), lambda builder, _found, *values: builder.fdiv(*values)),
    (primitives.sqrt, float64(float64), _llvm("llvm.sqrt")),
    (primitives.round_half_even, float64(float64), _llvm("llvm.rint")),
    (primitives.floor, float64(float64), _llvm("llvm.floor")),
    (primitives.ceil, float64(float64), _llvm("llvm.ceil")),
)
"""Primitives of one signature."""
