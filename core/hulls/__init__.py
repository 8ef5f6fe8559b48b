"""Collision hulls: cut a solid into pieces and put a convex shape around each."""
