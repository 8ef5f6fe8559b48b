"""The only code that turns Blender's data into arrays and back.

By package and module:

- `stored`: what a file keeps: names, notes and records.
- `mesh`: faces, points and layers as arrays.
- `homes`: where what belongs to an object goes in a file.
- `watching`: Blender tells of changes and of another file.
- `rays`: rays that Blender or Embree casts.
- `read`: an object becomes a shape.
- `parts`: parts on an object: read, written, named, colored and erased.
- `cuts`: faces that are cut where parts meet on them, and whole ones again.
- `views`: colors, the exploded view and isolated parts.
- `hulls`: hulls as objects.
- `work`: computations on objects.
- `refusals`: why an object cannot be worked on.
- `removal_refusals`: why nothing can be removed from an object.

Modules never import each other in a circle. Some packages do:
`tests/test_architecture.py` names the pairs.
"""
