"""Every setting: default, bounds, label and help, once. Loads no SciPy."""
