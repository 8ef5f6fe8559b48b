"""Clusters of samples from lines of sight: embedding, k-means, moves."""
