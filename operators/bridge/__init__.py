"""The only code that turns Blender's data into arrays and back.

The order is `mesh` (arrays and layers), `stored` (what a file keeps), `refusals` (why
an object cannot be worked on), `parts` (parts in Blender), `read` (an object becomes a
shape), `hulls` (hulls in Blender), `work` (computations on objects). Each imports only
from those before it. `rays` needs none of them, and `work` uses it.
"""
