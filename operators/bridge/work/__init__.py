"""The work that is done on objects, step by step."""
