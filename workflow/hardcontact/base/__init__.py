"""Numbers: statistics, units, random generators named for what they are for, printing."""
