"""From trees to the graph: what an expression means for one robot, in one scope, or all that is wrong with it."""
