"""Forces on filtered and perturbed surfaces, and the conclusions of both kinds of study.

The conclusions are the critical band, the octaves that matter, and range and work of adhesion.
"""
