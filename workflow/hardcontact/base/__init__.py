"""Files, units, statistics, named random generators and the printing of numbers."""
