"""Merges small parts, parts of a bend, and what no loop of creases divides."""
