"""Which samples see each other."""
