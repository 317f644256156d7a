"""Adhesion of hard, rough contacts: from topography to pull-off force, scale by scale."""
