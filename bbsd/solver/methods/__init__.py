"""Methods that search for designs, one module each, behind one interface (`method`).

A method spends a budget of episodes in rounds; between two rounds its state is a plain value that can be written down.
It hands out candidates; the race that chooses among them is the same for all.
"""
