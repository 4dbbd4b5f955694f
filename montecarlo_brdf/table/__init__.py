"""Tables of what a BRDF reflects, every cell with a certificate; what they lose between the cells,
polynomials in their place, and other people's tables and fits held against the truth."""
