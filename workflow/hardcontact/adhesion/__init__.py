"""Adhesion: force sum, pull-off, range and work of adhesion, critical band, classical models."""
