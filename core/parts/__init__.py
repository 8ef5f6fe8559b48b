"""From clusters of samples to parts of the surface, and their seams."""
