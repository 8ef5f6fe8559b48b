"""Files become objects.

`load` is the entry. It checks a file (`damage_checks`, and later `finite_checks`)
and calls the importer of its ending (`importers`): Blender's, or ours for .off
(`off_files`) and .xyz, .pwn, .pts (`xyz_files`).
"""
