"""Pull-off force and critical band from a spectrum alone, without a height map, in closed form."""
