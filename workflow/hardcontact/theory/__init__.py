"""Theory of the critical band: closed form, statistics, laws, scan sizes."""
