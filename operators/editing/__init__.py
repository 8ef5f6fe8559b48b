"""Operators that change parts by hand, and their names."""
