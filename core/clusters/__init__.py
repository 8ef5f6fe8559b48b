"""From lines of sight to clusters of samples: embedding, k-means, moves."""
