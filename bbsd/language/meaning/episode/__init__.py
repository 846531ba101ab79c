"""An episode as one graph: how it starts, what happens in a step, what behaviors perceive and a view shows."""
