"""Parts as Blender's data: groups, materials, attributes, objects.

What "the parts of an object" are depends on how much one has to know:

============== ========================== ============================================
type           is found by                says
============== ========================== ============================================
`Identity`     `noted_identities`         number, name and color of one part
`FoundParts`   `find_parts_on`            which parts there are, and that of each face
`PartFigures`  `figures_of`               and their areas and ranks, if they still hold
`PresentParts` `present_parts`            and locks, faces settled by hand: for edits
`Edited`       an edit or a run           what is to be written to the object
`ShownParts`   `shown_parts`              faces after modifiers: to draw, and to click
============== ========================== ============================================

`PartFigures` are `FoundParts`, and `PresentParts` are `PartFigures`. These three are
here; `Identity` is in `bridge/stored`, `Edited` in `bridge/work`, and `ShownParts` in
`operators/viewport`.

- The number of a part stays, and is on its faces, in the attribute `wcd_part`.
- Its place is that among all parts, by number. Labels of faces are places: they change
  as parts come and go.
- Its turn tells apart parts that have one number after a join: 0 for the object's own.
"""
