"""Maps of a texture as files: samples, formats, names, and the scenes that show them."""
