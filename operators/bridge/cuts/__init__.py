"""Objects whose faces are cut along seams, and the whole faces they had before."""
