"""What the user does and sees in the 3D viewport itself."""
