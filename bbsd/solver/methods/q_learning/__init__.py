"""Tabular Q-learning over the joint partition, of which the behaviors take over what they can."""
