"""What compiled code uses for `kernel.primitives`: one instruction each, the same bits, no branch."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from llvmlite import ir
from numba import boolean, float64, int64, types, uint64
from numba.extending import intrinsic

from bbsd.kernel import primitives

if TYPE_CHECKING:
    from collections.abc import Callable

    from numba.core.typing.context import Context
    from numba.core.typing.templates import Signature

    Emit = Callable[..., ir.Value]
    Typed = tuple[Signature, Emit]

FLOAT = ir.DoubleType()
WORD = ir.IntType(64)


def _intrinsic(typed: Callable[..., Typed]) -> Callable[..., Any]:
    made: Callable[..., Any] = intrinsic(typed)
    return made


def _instruction(signature: Signature, emit: Emit) -> Callable[..., Any]:
    """An intrinsic of one argument from a function that emits its instruction."""

    @_intrinsic
    def instruction(_typing: Context, _x: types.Type) -> Typed:
        return signature, lambda _target, builder, _signature, values: emit(builder, *values)

    return instruction


def _llvm(name: str, n_arguments: int = 1) -> Emit:
    """Emits a call of LLVM's intrinsic function of that name, all of whose arguments are floats."""
    called = ir.FunctionType(FLOAT, [FLOAT] * n_arguments)
    return lambda builder, *values: builder.call(
        builder.module.declare_intrinsic(name, [FLOAT], called), values
    )


_bits_of = _instruction(int64(float64), lambda builder, x: builder.bitcast(x, WORD))
_float_of = _instruction(float64(int64), lambda builder, x: builder.bitcast(x, FLOAT))
_sqrt = _instruction(float64(float64), _llvm("llvm.sqrt"))
_floor = _instruction(float64(float64), _llvm("llvm.floor"))
_ceil = _instruction(float64(float64), _llvm("llvm.ceil"))
_round_half_even = _instruction(float64(float64), _llvm("llvm.rint"))


@_intrinsic
def _copysign(_typing: Context, _magnitude: types.Type, _sign: types.Type) -> Typed:
    emit = _llvm("llvm.copysign", 2)
    return float64(float64, float64), lambda _target, builder, _signature, values: emit(builder, *values)


@_intrinsic
def _select(typing: Context, _condition: types.Type, then: types.Type, otherwise: types.Type) -> Typed:
    unify: Callable[..., Any] = typing.unify_types
    unliteral: Callable[..., Any] = types.unliteral
    value = unify(unliteral(then), unliteral(otherwise))
    return value(boolean, value, value), lambda _target, builder, _signature, values: builder.select(*values)


# numba finds a call's arguments by their names, so each stands here with those of its primitive.
COMPILED: tuple[tuple[Callable[..., Any], Callable[..., Any]], ...] = (
    (primitives.select, lambda condition, then, otherwise: _select(bool(condition), then, otherwise)),
    (primitives.bits_of, lambda x: _bits_of(float(x))),
    (primitives.float_of, lambda bits: _float_of(int64(bits))),
    (primitives.word_of, lambda number: uint64(int(number))),
    (primitives.copysign, lambda magnitude, sign: _copysign(float(magnitude), float(sign))),
    (primitives.divide, lambda dividend, divisor: dividend / divisor),
    (primitives.sqrt, lambda x: _sqrt(float(x))),
    (primitives.round_half_even, lambda x: _round_half_even(float(x))),
    (primitives.floor, lambda x: _floor(float(x))),
    (primitives.ceil, lambda x: _ceil(float(x))),
)
