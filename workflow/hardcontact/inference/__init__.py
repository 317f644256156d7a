"""Forces on filtered and perturbed surfaces, and what both kinds of study conclude from them.

The conclusions are the critical band, the octaves that matter, and range and work of adhesion.
"""
