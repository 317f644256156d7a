"""What decides the band: closed form, laws, maps, scan sizes, repeated contact."""
