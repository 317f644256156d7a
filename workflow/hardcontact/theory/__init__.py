"""What decides the band: closed form, statistics, laws, scan sizes."""
