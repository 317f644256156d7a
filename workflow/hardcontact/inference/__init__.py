"""Inference for both kinds of study: masters, edges of the band, octaves, range and work."""
