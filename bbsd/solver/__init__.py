"""The method: cooperative co-evolution, structure learning, culture, and the run of them all."""
