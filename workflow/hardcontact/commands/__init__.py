"""The commands: `hardcontact new`, `predict`, `verify` and `compare`."""
