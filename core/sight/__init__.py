"""Prepared shapes, rays through their inside, and which samples see each other."""
