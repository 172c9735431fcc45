"""Pictures as pixels and animations."""

import pytest

from models.world import builtin_environments, load_environment
from models.world.picture import picture, to_image, write_gif
from models.world.picture.layout import CELL, ROBOT
from models.world.picture.scene import MARGIN

Image = pytest.importorskip("PIL.Image", reason="pictures as pixels need Pillow")
ENVIRONMENT = load_environment(dict(builtin_environments())["toys-4x1-sphere"])
ROOMS = ("kitchen", "living_room", "bedroom", "bathroom")


def at(room):
    return ENVIRONMENT.world.decode(ENVIRONMENT.world.encode({"robot": {"at": room}}))


def test_the_robot_is_blue_where_it_is_and_only_there():
    for number, room in enumerate(ROOMS):
        image = to_image(picture(ENVIRONMENT, at(room)), width=832)  # two pixels to a hundredth of a cell
        assert image.size == (832, 232)
        colors = [
            image.getpixel((int(2 * (MARGIN + CELL * column + ROBOT[0])), int(2 * (MARGIN + ROBOT[1] + 4))))
            for column in range(len(ROOMS))
        ]
        blue = [column for column, (red, _, blue) in enumerate(colors) if blue > 200 and red < 120]
        assert blue == [number]


def test_a_gif_has_a_frame_for_each_picture_and_rests_at_its_end(tmp_path):
    path = tmp_path / "run.gif"
    write_gif(path, [picture(ENVIRONMENT, at(room)) for room in ROOMS], width=300, frame_ms=100)
    with Image.open(path) as gif:
        assert (gif.format, gif.n_frames, gif.info["loop"]) == ("GIF", 4, 0)
        durations = []
        for frame in range(gif.n_frames):
            gif.seek(frame)
            durations.append(gif.info["duration"])
    assert durations == [100, 100, 100, 400]
