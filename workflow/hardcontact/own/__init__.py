"""What only the user's surfaces need, in a study or in a prediction without a study.

In a study, `hindcast` tests the extrapolation, and `force_dataset` makes force.nc. For a
prediction, `own_spectrum` reads scans, `spectrum_table` a table of a spectrum, and `scan_force`
sums the force on a single map. For both, `wide_pixels` tests the pixels, and `scan_contact` chooses
the window of a contact.
"""
