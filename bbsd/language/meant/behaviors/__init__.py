"""Behaviors in other forms: dashes of rules, cells for a condition, layers with numbers."""
