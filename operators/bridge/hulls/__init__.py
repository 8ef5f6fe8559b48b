"""Hulls as objects of Blender."""
