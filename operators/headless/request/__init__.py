"""What the user asks for: the options of the command line, checked."""
