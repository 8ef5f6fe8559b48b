"""Merges parts: those too small, those that psi loses least by, and those of a bend."""
