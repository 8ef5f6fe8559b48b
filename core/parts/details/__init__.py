"""Parts of parts: what the samples of the whole shape are too few to show."""
