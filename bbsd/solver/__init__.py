"""The method: cooperative co-evolution, structure learning and culture, up to the answer and its judgement.

`generation` is the loop of Fig. 4: it takes a compiled problem, settings and a key from one state, which can be written
down, to the next. Below it stand its parts: `pairing`, `lifetime` with `estimates`, `structures` and `assignment`,
`sharing`, `culture`, `genetics` and `draws`. Another method would stand beside it with states of its own.

`answer`, `champions`, `race`, `judgement` and `random_agents` come after the loop, for any method. `bbsd.runs`, which
carries out runs, stands above: nothing here imports it.
"""
