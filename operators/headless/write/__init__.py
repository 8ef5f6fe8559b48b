"""Objects become files: models with parts, pictures of parts, and collision hulls."""
