from types import SimpleNamespace

from numba.core.compiler import DefaultPassBuilder, Flags
from numba.core.typed_passes import NativeLowering

from bbsd.kernel.jit import jit_kernel
from bbsd.kernel.lowering import KernelLowering
from bbsd.kernel.pipeline import PASSES


def test_the_passes_are_numba_s_own_in_their_order():
    state = SimpleNamespace(func_ir=None, flags=Flags())
    every = [each for each, _ in DefaultPassBuilder.define_nopython_pipeline(state).passes]
    own = {NativeLowering: KernelLowering}
    assert [own.get(each, each) for each in every if own.get(each, each) in PASSES] == [*PASSES]
    assert len(every) > len(PASSES)


def test_a_kernel_goes_through_these_passes_alone(tmp_path, monkeypatch):
    monkeypatch.setenv("BBSD_CACHE_DIR", str(tmp_path))

    def total(n):
        found = 0.0
        for k in range(n):
            found += k / 2.0
        return found

    compiled = jit_kernel(total)
    assert compiled(5) == 5.0
    [times] = compiled.get_metadata(compiled.signatures[0])["pipeline_times"].values()
    assert [name.partition("_")[2] for name in times] == [each.name() for each in PASSES]
