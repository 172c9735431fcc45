"""Pictures as pixels, by Pillow, and runs as animated GIFs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from models.world.picture.shapes import STYLES, Circle, Group, Line, Picture, Polygon, Rect, Shape, Text

OVERSAMPLED = 2
"""Pixels drawn for each one shown, across: what smooths the edges."""


def write_gif(path: Path, pictures: Sequence[Picture], *, width: int = 640, frame_ms: int = 450) -> None:
    """Write pictures of one size as a GIF that goes on for ever, and stands still for a moment at its end.

    Raises ImportError without Pillow, OSError when the file cannot be written.
    """
    frames = [to_image(picture, width=width).quantize(128) for picture in pictures]
    pause = [frame_ms] * (len(frames) - 1) + [4 * frame_ms]
    frames[0].save(path, format="GIF", save_all=True, append_images=frames[1:], duration=pause, loop=0, disposal=1)


def to_image(picture: Picture, *, width: int = 640) -> Any:
    """The picture as a `PIL.Image.Image` so many pixels wide. Raises ImportError without Pillow."""
    from PIL import Image, ImageDraw

    scale = OVERSAMPLED * width / picture.width
    size = (round(picture.width * scale), round(picture.height * scale))
    image = Image.new("RGB", size, "#ffffff")
    painter = _Painter(ImageDraw.Draw(image, "RGBA"))
    for part in picture.parts:
        painter.paint(part, 0.0, 0.0, scale)
    return image.resize((width, round(size[1] / OVERSAMPLED)), Image.Resampling.LANCZOS)


@dataclass(slots=True)
class _Painter:
    draw: Any  # of Pillow

    def paint(self, shape: Shape, x: float, y: float, scale: float, *, inside: bool = False) -> None:
        """Paint a shape whose (0, 0) is at a pixel, with so many pixels to its unit."""
        match shape:
            case Group():
                left, top = x + shape.x * scale, y + shape.y * scale
                for part in shape.parts:
                    self.paint(part, left, top, scale * shape.scale, inside="inside" in shape.kind.split())
            case Rect():
                box = [x + shape.x * scale, y + shape.y * scale]
                box += [box[0] + shape.width * scale, box[1] + shape.height * scale]
                self.draw.rounded_rectangle(box, radius=shape.radius * scale, **_look(shape.kind, shape.fill, scale))
            case Circle():
                middle, radius = (x + shape.x * scale, y + shape.y * scale), shape.radius * scale
                box = [middle[0] - radius, middle[1] - radius, middle[0] + radius, middle[1] + radius]
                self.draw.ellipse(box, **_look(shape.kind, shape.fill, scale))
            case Polygon():
                self.draw.polygon(_at(shape.points, x, y, scale), **_look(shape.kind, shape.fill, scale))
            case Line():
                look = _look(shape.kind, None, scale)
                self.draw.line(_at(shape.points, x, y, scale), fill=look["outline"], width=look["width"])
            case Text():
                if not (inside and "part" in shape.data):
                    self._write(shape, x, y, scale)

    def _write(self, text: Text, x: float, y: float, scale: float) -> None:
        from PIL import ImageFont

        font = ImageFont.load_default(text.size * scale)
        place = (x + text.x * scale, y + text.y * scale)
        self.draw.text(place, text.text, font=font, fill=STYLES[text.kind].fill, anchor="ms" if text.middle else "ls")


def _at(points: Sequence[tuple[float, float]], x: float, y: float, scale: float) -> list[tuple[float, float]]:
    return [(x + across * scale, y + down * scale) for across, down in points]


def _look(kind: str, fill: str | None, scale: float) -> dict[str, Any]:
    style = STYLES[kind]
    color = fill or style.fill
    if color and style.opacity < 1:
        color += f"{round(255 * style.opacity):02x}"
    return {"fill": color, "outline": style.stroke, "width": max(1, round(style.width * scale)) if style.stroke else 0}
