"""`bbsd design`: its options and budgets, where runs are done, what is said and drawn, how it is continued."""
