"""Adhesion: the force sum, the pull-off force of pairs of scans, its means and distributions."""
