"""Many equally good sets of substitute scans: their pool, the draw, the numbers of each set."""
