"""Theory of the critical band: closed form, statistics of forces, predictions."""
