"""Files, units, statistics, random generators for named purposes, and the formatting of numbers."""
