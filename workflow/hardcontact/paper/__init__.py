"""What only the study of the paper needs: sets of scans, classical models, claims.

`sets` repeats band and fit with other scans, from `pool` and `featured_candidates`. `posterior`
weighs ranges and works of adhesion by these sets. `classical_comparison` applies classical models.
`claims` judges, unless `changed_inputs` finds inputs that are not the paper's.
"""
