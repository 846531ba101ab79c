"""A spec's own world for other libraries: as an environment of Gymnasium, many lanes of one, or one of PettingZoo."""
