"""Files, units, published numbers, statistics, random generators, progress and formatting."""
