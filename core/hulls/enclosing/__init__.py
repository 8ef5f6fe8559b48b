"""The smallest shapes around convex hulls."""
