"""What studies conclude from forces: the band, the octaves that matter, range and work of adhesion.

Where the paper's study, with many scans, and one of the user's surfaces, with few, need different
statistics, each has a module beside the common one. `edges` finds the band; its intervals come from
`edges_of_masters` or `edges_of_scans`. `fit` finds the best pair of range and work;
`published_fit` and `measured_fit` add what the forces permit. Means and their intervals come from
`force_statistics` for many scans, and from `mean_forces` and `scan_parts` for few.
"""
