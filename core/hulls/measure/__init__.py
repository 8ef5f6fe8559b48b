"""Measures how far a collision shape strays from the solid that it stands for."""
