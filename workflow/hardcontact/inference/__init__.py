"""What studies conclude from forces: the band, the octaves that matter, range and work of adhesion.

`forces_on_masters`, `octaves` and `band_forces` compute forces on changed roughness. Statistics
differ, because the paper's study has many substitutes of a surface, a user often one or two scans:

- mean forces: `force_statistics` for substitutes; `mean_forces` and `scan_parts` for your
  scans;
- the band: `edges`;
- range and work: `fit` finds the best pair, `published_fit` and `measured_fit` the other pairs that
  the published or your forces permit.
"""
