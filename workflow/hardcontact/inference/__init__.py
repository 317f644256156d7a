"""What forces tell: means and intervals, edges of the band, range and work of adhesion."""
