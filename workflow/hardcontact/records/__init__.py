"""Records of what made each file: a job, its parameters, inputs, code and package versions."""
