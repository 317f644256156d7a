"""What only the study of the paper needs: fits to published forces, sets of scans, claims.

`published_fit` and `posterior` infer range and work of adhesion, `edges_of_masters` finds the band,
`exponents` its dependence on radius and load, `classical_comparison` applies classical models.
`sets` repeats this with other scans, from `pool` and `featured_candidates`. `claims` judges.
"""
