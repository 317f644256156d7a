"""Two bodies in contact: from their gaps to contact pixels and pull-off forces.

Read `contact` (what contacts share), `geometry` (their array and gaps), `bearing_area` (contact
pixels), `force_sum`, then `pull_off`. `indents`, `attraction` and `elastic` look closer at single
contacts, `hertz_jkr_dmt` has the closed forms of smooth spheres, and `numerical_limits` says which
ranges, windows and scans suffice. `rho` is one range of adhesion in nm, `ranges` are several.
"""
