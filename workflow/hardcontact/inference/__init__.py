"""Forces on filtered and perturbed surfaces, and the conclusions of both kinds of study.

The conclusions are the band, the octaves that matter, and range and work of adhesion.
"""
