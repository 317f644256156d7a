"""What studies conclude from forces: the band, the octaves that matter, range and work of adhesion.

`forces_on_masters`, `octaves` and `band_forces` compute forces on changed roughness. The paper's
study has many scans, one of the user's surfaces few. Where they need different statistics, each has
a module beside the common one. `edges` finds the band; its intervals come from `edges_of_masters`
or `edges_of_scans`. `fit` finds the best pair of range and work; `published_fit` and `measured_fit`
find which other pairs the forces permit. Means and their intervals come from `force_statistics` for
many scans, from `mean_forces` and `scan_parts` for few, and from `measured_forces` if measured.
"""
