"""What only your surfaces need, in a study or in a prediction without a study."""
