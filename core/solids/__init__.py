"""Solids: which surfaces bound one, which way it faces, how heavy it is."""
