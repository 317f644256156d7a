"""Inference from forces: means and intervals, edges of the band, range and work of adhesion."""
