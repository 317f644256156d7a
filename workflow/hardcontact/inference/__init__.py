"""From forces on filtered and changed surfaces to the critical band, octaves, range and work."""
