"""Long computations: in steps, in slices of time, on one thread, with a memo."""
