"""Small synthetic datasets and published tables of the form that figures are drawn from."""
