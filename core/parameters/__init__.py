"""Defines each setting once: default, bounds, label and help. Imports no SciPy."""
