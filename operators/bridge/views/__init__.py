"""Ways to look at parts: exploded, isolated, and with their colors as an overlay."""
