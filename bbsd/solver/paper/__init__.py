"""The paper's loop (Fig. 4): co-evolution of modules, learning of their order in lifetimes, sharing, culture."""
