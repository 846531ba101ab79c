"""The method: cooperative co-evolution, structure learning and culture, up to the answer and its judgement."""
