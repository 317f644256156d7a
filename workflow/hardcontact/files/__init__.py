"""The paths of a study, and the lists of files that rules ask for."""
