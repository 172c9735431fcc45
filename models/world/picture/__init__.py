"""What worlds look like: SVG, pixels and text, from the environment alone."""

from models.world.picture.layout import CELL, Layout, Spot, layout_of
from models.world.picture.raster import to_image, write_gif
from models.world.picture.scene import MOST_CELLS, picture, said, size_of
from models.world.picture.shapes import Picture
from models.world.picture.svg import to_svg
from models.world.picture.terminal import changes, to_text

__all__ = [
    "CELL",
    "MOST_CELLS",
    "Layout",
    "Picture",
    "Spot",
    "changes",
    "layout_of",
    "picture",
    "said",
    "size_of",
    "to_image",
    "to_svg",
    "to_text",
    "write_gif",
]
