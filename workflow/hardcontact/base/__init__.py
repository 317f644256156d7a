"""Files, units, statistics, named random generators, and the formatting of numbers."""
