"""Two bodies in contact: from their gaps to contact pixels and pull-off forces.

Read `contact` (sphere and load), `geometry` (array and gaps), `bearing_area` (contact pixels),
`force_sum`, then `pull_off`. `indents`, `attraction` and `elastic` look closer at single contacts,
and `patches` groups their pixels. `hertz_jkr_dmt` has closed forms for smooth spheres.
`numerical_limits` gives the ranges, windows and scans that suffice. `rho` is one range of adhesion
in nm, `ranges` are several.
"""
