"""A run of the command line: each input, its objects, and what became of them."""
