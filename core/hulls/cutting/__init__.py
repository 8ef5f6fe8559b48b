"""Cuts of a solid into pieces whose hulls are close."""
