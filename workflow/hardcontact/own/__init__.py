"""What only the user's surfaces need, in a study or in a prediction without a study.

In a study, `hindcast` tests the extrapolation, `wide_pixels` the pixels, and `force_at_pair` makes
force.nc. For a prediction, `own_spectrum` reads scans and `spectrum_table` a table of a spectrum;
`scan_contact` and `scan_force` sum the force on a single map.
"""
