"""Tables as files, each format in a file of its name: NumPy, CSV, C and OpenEXR."""
