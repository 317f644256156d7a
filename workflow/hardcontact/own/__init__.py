"""The commands: `hardcontact new` and `hardcontact predict`."""
