"""The only code that turns Blender data into arrays and back."""
