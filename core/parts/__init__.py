"""Turns clusters of samples into connected parts of the surface, and cuts seams."""
