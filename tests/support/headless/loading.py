"""Loads files as the command line does."""

from weak_convex_decomposition.operators.headless.read.load import load_file


def load(path, up=None):
    """Load a file and return its mesh objects, by name, without their modifiers."""
    return load_file(path, up, with_modifiers=False).objects
