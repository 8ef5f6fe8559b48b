"""Objects become files."""
