"""How operators run long computations, and on which objects.

Who works after a click, each in slices of time between Blender's own events:

1. A button runs `computation` in `modal`: one run at a time, until Esc.
2. A slider, in `operators/recut.py`, waits for parts for less than 0.1 s. What takes
   longer goes on as such a run. In Object Mode it may be a first look at the parts.
3. `refine` replaces a first look by the parts once settings rest and no run goes on.
   Undo, redo and loading may bring one back. Saving waits for the parts.
4. `ahead` finds other numbers of parts for the next slider, while neither works. It
   writes nothing.
5. `joins` looks after each change of objects, since a join may need work on views.

Without a window, 1 to 3 are done at once, and `ahead` does nothing.
"""
