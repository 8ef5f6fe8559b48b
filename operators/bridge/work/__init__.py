"""Work on Blender objects, as steps: decompose, measure, edit, build hulls."""
