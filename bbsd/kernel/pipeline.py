"""The passes of numba that a kernel needs.

The source of a kernel has no closures, no `with`, no branches on constants and no array expressions, so nothing needs
to be found and rewritten before types are inferred; on a long kernel those passes take a tenth of the time. A variable
has one type wherever it is assigned, so assignments need not be told apart, which takes a time that grows with the
number of variables times the number of loops.
"""

from __future__ import annotations

from numba.core.compiler import CompilerBase
from numba.core.compiler_machinery import PassManager
from numba.core.typed_passes import (
    IRLegalization,
    NoPythonBackend,
    NopythonTypeInference,
    PreLowerStripPhis,
)
from numba.core.untyped_passes import FixupArgs, IRProcessing, TranslateByteCode

from bbsd.kernel.lowering import KernelLowering

PASSES = (
    TranslateByteCode,
    FixupArgs,
    IRProcessing,
    NopythonTypeInference,
    PreLowerStripPhis,
    IRLegalization,
    KernelLowering,
    NoPythonBackend,
)


class KernelCompiler(CompilerBase):
    """Numba's compiler with the passes of a kernel only."""

    def define_pipelines(self) -> list[PassManager]:
        """Return the only pipeline."""
        passes = PassManager("kernel")
        for compiler_pass in PASSES:
            passes.add_pass(compiler_pass, compiler_pass.__name__)
        passes.finalize()
        return [passes]
