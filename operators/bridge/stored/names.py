"""Every name under which the extension keeps something in a file."""

from __future__ import annotations

# Custom property of an object: its result, JSON for people and programs.
RESULT = "wcd"
# Custom property of a mesh: how to bring it back, JSON.
RESTORE = "wcd_restore"
# Custom properties of a mesh whose faces are cut: the mesh with the whole faces, and
# what shows that the cut one was edited since.
WHOLE_MESH = "wcd_whole_mesh"
CUT_STATE = "wcd_cut_state"
# Attribute of faces that are cut: the number of the whole face.
WHOLE_LAYER = "wcd_whole_face"

# Attribute of faces, or of points: the number of the part, counted from 0.
PART_LAYER = "wcd_part"
# Attribute of faces, or of points: 1 where the user settled the part by hand.
HAND_LAYER = "wcd_hand"
# Attribute of faces: the material index before ours.
MATERIAL_LAYER = "wcd_material_index"
# Attribute of faces whose parts' colors are an overlay: whose parts they are.
OWNER_LAYER = "wcd_owner"
# Attribute of the same faces: the checksum of the name of their part's group.
GROUP_LAYER = "wcd_group"
# Attribute of faces: the face set before ours, 0 where the mesh had none.
FACE_SET_LAYER = "wcd_face_set"
# Attribute of face corners, or of points: the color of the part.
COLOR_LAYER = "wcd_color"
# Attribute of points: the normals that we estimated.
NORMAL_LAYER = "wcd_normal"
# Attribute of edges: 1 where we marked a seam that was not there before.
SEAM_LAYER = "wcd_seam"
# All attributes of faces or points of ours, with their data types.
LAYERS = {
    PART_LAYER: "INT",
    HAND_LAYER: "INT",
    MATERIAL_LAYER: "INT",
    OWNER_LAYER: "INT",
    GROUP_LAYER: "INT",
    FACE_SET_LAYER: "INT",
    COLOR_LAYER: "FLOAT_COLOR",
    NORMAL_LAYER: "FLOAT_VECTOR",
}
# Blender's own attribute for the face sets of Sculpt Mode, counted from 1.
FACE_SETS = ".sculpt_face_set"

# Custom properties of a mesh with colors as an overlay: the materials that its parts
# had, by number, and the value of `OWNER_LAYER` on its own faces.
KEPT_MATERIALS = "wcd_overlay"
OWNER = "wcd_owner"

# Custom properties of a material of ours: the number and the name of the part. Those of
# other things have numbers below 0.
MATERIAL_TAG = "wcd_part"
MATERIAL_NAME = "wcd_name"
# Custom property of such a material: what its faces had in its place, JSON.
FORMER_SLOTS = "wcd_slots"
# Custom property of hulls: the figures of a hull. Of the collections made for them: the
# name of their object.
HULL_TAG = "wcd_hull"
# Custom property of hulls: the points of the piece that it is around.
PIECE_TAG = "wcd_piece"
# And where the vertices of the hull were then: Blender's Apply moves these alone.
CORNERS_TAG = "wcd_corners"
# And there if these points have the margin already, as those of a convex hull have.
MARGIN_TAG = "wcd_margin"
# Custom property of objects that we made rigid bodies, and of our collection of bodies.
RIGID_TAG = "wcd_rigid"
# Custom property of the node group that makes exploded views.
EXPLODE_TAG = "wcd_explode"
# Custom property of the node group that isolates parts.
ISOLATE_TAG = "wcd_isolate"
# Custom property of the node group that realizes instances while a mesh is read.
REALIZE_TAG = "wcd_realize"
# Custom property of our images: the name of the object that they show. Of objects: the
# names that they had when pictures were made of them.
IMAGE_TAG = "wcd_picture"
# And what they show of it: the label of a kind of picture.
PICTURE_TAG = "wcd_picture_kind"
# Custom property of mesh objects with the parts of a curve: the name of the curve. Of
# their meshes: the name of the mesh object, by which it is told from copies.
CARRIER_TAG = "wcd_parts_of"
# Custom property of such an object: how the curve was shown before we hid it.
HIDDEN_TAG = "wcd_hidden"
# And where it was read, and hidden: the names of the scene and the view layer.
HIDDEN_IN_TAG = "wcd_hidden_in"

# Bytes that Blender keeps of the name of a vertex group.
LONGEST_NAME = 63
