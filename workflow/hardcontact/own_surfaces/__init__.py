"""Answers for own surfaces: few scans, own forces, edges that may be open."""
