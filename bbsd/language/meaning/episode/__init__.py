"""An episode as one graph: its start, the phases of a step, what behaviors perceive and a view shows."""
