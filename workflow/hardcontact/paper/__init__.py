"""What only the study of the paper needs: sets of scans, classical models, claims.

`sets` repeats fit and band with other scans (`pool`, `featured_candidates`) and other masters.
`posterior` weighs ranges and works of adhesion by these sets. `claims` judges the paper, unless
`changed_inputs` finds inputs that are not the paper's.
"""
