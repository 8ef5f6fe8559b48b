"""Seams between parts: where they run, and how smooth they are."""
