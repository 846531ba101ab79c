"""The machinery that carries out the method: runs, their folder and checkpoints, processes, prices, interrupts."""
