"""What a person types: `hardcontact new` and `hardcontact predict`."""
