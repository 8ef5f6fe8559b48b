"""The text before and after the options in --help."""

from __future__ import annotations

from ..formats import HULL_ENDINGS, MODEL_ENDINGS, READ_ENDINGS

DESCRIPTION = f"""\
Split models into weakly convex parts, and build collision hulls of them.

INPUT ends in one of {" ".join(READ_ENDINGS)}.
Every mesh and point cloud in it is decomposed. Name the files to write by --output,
--picture, --hulls and --report. Results are printed to standard output; progress,
warnings and errors to standard error."""

EPILOG = f"""\
examples:
  %(prog)s chair.obj --output chair-parts.blend --picture chair.png
  %(prog)s a.stl b.stl --output '{{name}}-parts.glb' --parts 6
  %(prog)s chair.obj --hulls chair-hulls.glb --naming unity --max-hulls 8
  %(prog)s chair.obj --output chair.fbx --with-hulls

several inputs:
  OUTPUT, PICTURE and HULLS must contain {{name}}. It stands for the name of the input
  without its ending.

formats of OUTPUT ({" ".join(MODEL_ENDINGS)}):
  .blend  everything: materials, vertex groups, the face attribute wcd_part, the record
  .glb    one material for each part; the record is in the extras of the node
  .obj    one material and one group for each part; an .mtl file is written beside it
  .ply    colors and part numbers on the vertices; vertices on seams are doubled
  .usd    one material for each part
  .fbx    one material for each part; hulls are named for Unreal: UCX_Name_01
  with --with-hulls, .blend, .glb, .usd and .fbx have the hulls, too

formats of HULLS ({" ".join(HULL_ENDINGS)}):
  .glb .obj .usd  one object for each hull
  .stl            all hulls in one mesh
  .urdf .xml      for simulators (.xml is MuJoCo's MJCF): bodies with mass and inertia;
                  each mesh is an .obj file in a folder beside it: z_urdf for z.urdf

files that exist:
  They are replaced once the new ones are complete. Links are followed; pipes and
  devices are written to. Missing folders are made. In the folder of a simulator file
  only files that this program wrote are replaced or removed.

exit status:
  0  everything was done
  1  something failed; the rest was done
  2  the options are wrong; nothing was done
  130  interrupted; the report tells of what was finished"""
