"""Two bodies in contact: from their gaps to contact pixels and pull-off forces.

Read `geometry` (arrays of contacts, gaps), `bearing_area` (contact pixels), `force_sum`, then
`pull_off`. `indents`, `attraction` and `elastic` look closer at contacts; `hertz_jkr_dmt` has
the closed forms of smooth spheres.
"""
