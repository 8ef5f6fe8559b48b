"""The command line: files in, files out, without a window.

`command_line` starts, `run/decompose_file` is the way of one input. `request` holds the
options, `read` turns files into objects, `write` turns objects into files.
"""
