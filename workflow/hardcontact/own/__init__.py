"""What only studies of the user's surfaces need: tests of the extrapolation, predicted forces."""
