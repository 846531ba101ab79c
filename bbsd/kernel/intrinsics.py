"""What compiled code uses for `kernel.primitives`: one instruction each, the same bits, no branch. Imported by `kernel.jit`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from llvmlite import ir
from numba import boolean, float64, int64, types, uint64
from numba.extending import intrinsic, overload

from bbsd.kernel import primitives

if TYPE_CHECKING:
    from collections.abc import Callable

    Emit = Callable[..., Any]

FLOAT = ir.DoubleType()
WORD = ir.IntType(64)


def _instruction(result: Any, argument: Any, emit: Emit) -> Any:
    """An intrinsic of one argument from a function that emits its instruction."""

    @intrinsic
    def emitted(_typing: Any, x: Any) -> tuple[Any, Emit] | None:  # numba reads the argument's name
        if not isinstance(x, types.Number):
            return None
        return result(argument), lambda _target, builder, _signature, values: emit(builder, *values)

    return emitted


def _llvm_function(name: str) -> Emit:
    return lambda builder, *values: builder.call(
        builder.module.declare_intrinsic(name, [FLOAT], ir.FunctionType(FLOAT, [FLOAT] * len(values))), values
    )


_bits_of = _instruction(int64, float64, lambda builder, x: builder.bitcast(x, WORD))
_float_of = _instruction(float64, int64, lambda builder, x: builder.bitcast(x, FLOAT))
_sqrt = _instruction(float64, float64, _llvm_function("llvm.sqrt"))
_floor = _instruction(float64, float64, _llvm_function("llvm.floor"))
_ceil = _instruction(float64, float64, _llvm_function("llvm.ceil"))
_round_half_even = _instruction(float64, float64, _llvm_function("llvm.rint"))


@intrinsic
def _copysign(_typing: Any, magnitude: Any, sign: Any) -> tuple[Any, Emit]:
    emit = _llvm_function("llvm.copysign")
    return float64(float64, float64), lambda _target, builder, _signature, values: emit(builder, *values)


@intrinsic
def _select(typing: Any, condition: Any, then: Any, otherwise: Any) -> tuple[Any, Emit]:
    value = typing.unify_types(types.unliteral(then), types.unliteral(otherwise))
    return value(boolean, value, value), lambda _target, builder, _signature, values: builder.select(*values)


OVERLOADS: tuple[tuple[Callable[..., Any], Callable[..., Any]], ...] = (
    (primitives.select, lambda condition, then, otherwise: _select(condition, then, otherwise)),
    (primitives.bits_of, lambda x: _bits_of(x)),
    (primitives.float_of, lambda bits: _float_of(bits)),
    (primitives.word_of, lambda number: uint64(number)),
    (primitives.copysign, lambda magnitude, sign: _copysign(magnitude, sign)),
    (primitives.divide, lambda dividend, divisor: dividend / divisor),
    (primitives.sqrt, lambda x: _sqrt(x)),
    (primitives.round_half_even, lambda x: _round_half_even(x)),
    (primitives.floor, lambda x: _floor(x)),
    (primitives.ceil, lambda x: _ceil(x)),
)


def register(**options: bool | str) -> None:
    """Gives compiled code the instruction of every primitive."""
    for primitive, compiled in OVERLOADS:
        overload(primitive, jit_options=options, strict=False)(lambda *_given, _compiled=compiled: _compiled)
