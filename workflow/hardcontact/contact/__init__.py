"""Two bodies in contact: from their gaps to contact pixels and pull-off forces.

Read `contact` (sphere and load), `geometry` (positions and gaps), `bearing_area` (contact pixels),
`force_sum`, then `pull_off`. `rho` is one range of adhesion in nm, `ranges` are several.
"""
