"""What the method achieves: each module designs shipped specs with ten seeds and compares what comes out with a claim.

- `make claims`: the claims of README.md. `make worlds`: learned designs of the shipped worlds beside the hand-made ones
  (`make worlds WORLD=pursuit` for one). `make arms`: the paper's arms of the lifting task and its claims on them.
- `make optimum`: the best return that a task allows, by dynamic programming (`make optimum SPEC=...` for others).
- `make methods`: all methods on all tasks at equal budgets; [its page](../docs/methods.md) has what came out.
- `python -m experiments.learners`: PPO and DQN of stable-baselines3 beside designs, with as many steps of the world; it
  needs that library, and nothing else runs it.
- `designs.py` has what they share: the specs, the seeds, and the returns of a finished design on given episodes.

To add one: write a module with `main()` that prints a line for each figure and returns 1 if a claim fails, and give it
a target in the Makefile.
"""
