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

Each part has a material, which nothing else has but its hulls. Who knows what of it:

================== ===================================================================
`materials`        is it ours or the user's; make, name, color and remove it
`slots`            put it into a slot after the user's; Clear takes it out: faces get
                   the material back that they had, or keep what the user gave them
`stored/restore`   how slots, groups and faces were before, noted on the mesh
`part_materials`   which part has it, in a slot, or kept on the mesh while colors are an
                   overlay; then marks on faces tell what slots do otherwise
`joined`           whose faces are after a join: asks slots and marks
`views/colors`     from slots to an overlay, and back
================== ===================================================================

A join with another object that has parts leaves its faces, with the numbers of their
parts, and its materials in slots behind; its record is gone. So, one after the other:

1. `joined` tells faces of both objects apart that have one number: by marks, by the
   material of the part, or, for copies, because the same faces come again.
2. `read` makes a part of each number and turn. Those that are not in the record get
   numbers, names and colors that are free.
3. `figures` say that parts are not listed. Refresh, an edit or a run lists them, and
   `work/in_step` does where nobody can ask for it.
4. `slots` gives faces back what they had, as Clear needs it: each material of a part
   notes which slots its own object had before.
"""
