"""Write Blender's monkey, subdivided twice, to the .obj file named on the command line.

Only a primitive and an exporter of Blender: the demonstration needs no data.
"""

import sys

import bpy

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_monkey_add()
suzanne = bpy.context.active_object
suzanne.modifiers.new("Subdivision", "SUBSURF").levels = 2
bpy.ops.wm.obj_export(filepath=sys.argv[1], export_materials=False)
