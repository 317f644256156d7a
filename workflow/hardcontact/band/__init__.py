"""Scales of roughness: filtered masters, the critical band and its edges."""
