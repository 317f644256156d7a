"""Contacts that are given by their area."""

from hardcontact.contact.contact import Contact


def contact_of_area(radius, rho, work, area):
    """Return a contact whose preload an area in nm² carries, at a hardness of 1 N/nm²."""
    return Contact(radius=radius, range=rho, work=work, preload=area, hardness=1e18)
