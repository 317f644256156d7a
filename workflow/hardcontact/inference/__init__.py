"""Forces on surfaces without some waves, or with other amplitudes, and conclusions from forces.

Both kinds of study conclude the band, the octaves that matter, and range and work of adhesion.
"""
