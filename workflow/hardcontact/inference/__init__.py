"""What studies conclude from forces: the band, the octaves that matter, range and work of adhesion.

`forces_on_masters`, `octaves` and `band_forces` compute forces on changed roughness. The paper's
study has many substitutes of a surface, a user often one or two scans. So both need different
statistics:

- mean forces: `force_statistics` for substitutes; `mean_forces` and `scan_parts` for the user's
  scans; `measured_forces` for the user's measurements;
- the band: `edges` finds it, with intervals from `edges_of_masters` or `edges_of_scans`;
- range and work: `fit` finds the best pair, `published_fit` and `measured_fit` find which other
  pairs the published or the user's forces permit.
"""
