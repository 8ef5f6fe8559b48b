"""Files in, files out, without a window."""
