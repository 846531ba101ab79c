"""Running what was exported through the real targets, in cells of the joint space."""
