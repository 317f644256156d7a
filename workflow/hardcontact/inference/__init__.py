"""Forces on filtered and perturbed surfaces, and what both kinds of study conclude from forces.

These are the band, the octaves that matter, and range and work of adhesion.
"""
