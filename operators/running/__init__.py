"""How operators run long computations, and on which objects."""
