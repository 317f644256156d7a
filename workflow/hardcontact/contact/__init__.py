"""Two bodies in contact: their gaps, contact pixels, pull-off forces, asperities and elasticity."""
