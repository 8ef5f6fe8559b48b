"""Files become objects."""
