"""Cuts through large faces, along seams that were found on a finer mesh."""
