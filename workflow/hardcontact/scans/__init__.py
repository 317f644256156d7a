"""Measured scans: reading of files, defects, reliable bands, the spectrum that they give."""
