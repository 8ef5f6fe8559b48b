"""The decomposition itself: NumPy, SciPy and scikit-learn, nothing of Blender."""
