"""The paths of a study, the settings in their digests, and the chunks that jobs compute."""
