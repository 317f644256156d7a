"""What only studies of the user's surfaces need: tests of the extrapolation, predicted forces.

`hindcast` tests the extrapolation, `force_at_pair` makes force.nc. For predictions without a study,
`own_spectrum` reads files, `scan_contact` and `scan_force` sum the force on a single map.
"""
