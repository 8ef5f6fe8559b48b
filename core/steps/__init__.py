"""How long computations run: in steps, in slices of time, remembered."""
