"""Collision hulls: a solid cut into pieces, and convex shapes around them."""
