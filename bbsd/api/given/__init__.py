"""What the verbs are given: their arguments, specs in any form, the environments that these name."""
