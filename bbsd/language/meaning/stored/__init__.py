"""Values that are kept from step to step, world and state: their forms, and how actions set elements of lists."""
