"""Messages of the schemas that viewers know: the only module that knows their packages.

The map frame is that of the road network: x east, y north, z up, in metres.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import Any, TypeAlias

from xavi_dialogue.storage.message_format import MessageFormat
from xavi_dialogue.viewers import MISSING

try:
    from foxglove_schemas_protobuf.Color_pb2 import Color
    from foxglove_schemas_protobuf.CubePrimitive_pb2 import CubePrimitive
    from foxglove_schemas_protobuf.FrameTransform_pb2 import FrameTransform
    from foxglove_schemas_protobuf.LinePrimitive_pb2 import LinePrimitive
    from foxglove_schemas_protobuf.Log_pb2 import Log
    from foxglove_schemas_protobuf.Odometry_pb2 import Odometry
    from foxglove_schemas_protobuf.Point3_pb2 import Point3
    from foxglove_schemas_protobuf.Pose_pb2 import Pose
    from foxglove_schemas_protobuf.PosesInFrame_pb2 import PosesInFrame
    from foxglove_schemas_protobuf.Quaternion_pb2 import Quaternion
    from foxglove_schemas_protobuf.SceneEntity_pb2 import SceneEntity
    from foxglove_schemas_protobuf.SceneEntityDeletion_pb2 import SceneEntityDeletion
    from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
    from foxglove_schemas_protobuf.SpherePrimitive_pb2 import SpherePrimitive
    from foxglove_schemas_protobuf.TextPrimitive_pb2 import TextPrimitive
    from foxglove_schemas_protobuf.TriangleListPrimitive_pb2 import TriangleListPrimitive
    from foxglove_schemas_protobuf.Vector3_pb2 import Vector3
    from google.protobuf.timestamp_pb2 import Timestamp
    from mcap_protobuf.schema import build_file_descriptor_set
except ImportError as error:
    raise ImportError(MISSING) from error

MAP = "map"
CAR = "car"
NANO = 1_000_000_000
FONT = 14.0  # [px] on the screen

Place: TypeAlias = tuple[float, float, float]  # [m]
Colour: TypeAlias = tuple[float, float, float, float]  # red, green, blue, opacity from 0 to 1
Part: TypeAlias = Any  # a primitive of a scene
Message: TypeAlias = Any  # a message of protobuf


@dataclass(frozen=True, slots=True)
class Box:
    """A box that stands on the ground."""

    place: Place  # [m] its middle
    heading: float  # [rad]
    size: Place  # [m] length, width, height


def stamp(time: float) -> int:
    """Return the time of a message [ns]: the ride begins at 0."""
    return round(max(time, 0.0) * NANO)


def form(message: Message) -> MessageFormat:
    """Return the format of a message."""
    kind: Any = type(message)
    return _form(kind)


@cache
def _form(kind: Any) -> MessageFormat:
    schema = build_file_descriptor_set(kind).SerializeToString()
    return MessageFormat(kind.DESCRIPTOR.full_name, "protobuf", schema)


def encode(message: Message) -> bytes:
    """Return a message as it is written; the same message gives the same bytes."""
    return bytes(message.SerializeToString(deterministic=True))


def cube(box: Box, colour: Colour) -> Part:
    """Return a box."""
    length, width, height = box.size
    size = Vector3(x=length, y=width, z=height)
    return CubePrimitive(pose=_pose(box.place, box.heading), size=size, color=_colour(colour))


def ball(place: Place, diameter: float, colour: Colour) -> Part:
    """Return a ball."""
    size = Vector3(x=diameter, y=diameter, z=diameter)
    return SpherePrimitive(pose=_pose(place), size=size, color=_colour(colour))


def label(text: str, place: Place, colour: Colour) -> Part:
    """Return a text that faces the viewer."""
    return TextPrimitive(
        pose=_pose(place),
        billboard=True,
        font_size=FONT,
        scale_invariant=True,
        color=_colour(colour),
        text=text,
    )


def line(points: Sequence[Place], width: float, colours: Sequence[Colour]) -> Part:
    """Return a line; there is a colour for each point, or one for all."""
    several = len(colours) == len(points)
    return LinePrimitive(
        type=LinePrimitive.LINE_STRIP,
        pose=_pose((0.0, 0.0, 0.0)),
        thickness=width,
        points=[_point(point) for point in points],
        color=_colour(colours[0]),
        colors=[_colour(one) for one in colours] if several else [],
    )


def surface(corners: Sequence[Place], triangles: Iterable[int], colour: Colour) -> Part:
    """Return triangles; each is three numbers of corners."""
    return TriangleListPrimitive(
        pose=_pose((0.0, 0.0, 0.0)),
        points=[_point(corner) for corner in corners],
        color=_colour(colour),
        indices=triangles,
    )


_LISTS = {
    CubePrimitive: "cubes",
    SpherePrimitive: "spheres",
    TextPrimitive: "texts",
    LinePrimitive: "lines",
    TriangleListPrimitive: "triangles",
}


def entity(name: str, time: float, parts: Iterable[Part]) -> Message:
    """Return a thing in the scene; it stays until one of the same name replaces it."""
    lists: dict[str, Any] = {}
    for part in parts:
        lists.setdefault(_LISTS[type(part)], []).append(part)
    return SceneEntity(timestamp=_time(time), frame_id=MAP, id=name, **lists)


def scene(entities: Iterable[Message], gone: Iterable[str] = (), time: float = 0.0) -> Message:
    """Return an update of the scene.

    Args:
        entities: that are added or replaced.
        gone: names of entities that are removed.
        time: [s] of the removals.
    """
    deletions = [SceneEntityDeletion(timestamp=_time(time), id=name) for name in gone]
    return SceneUpdate(deletions=deletions, entities=entities)


def frame(time: float, place: Place, heading: float) -> Message:
    """Return the place of our own car on the map."""
    return FrameTransform(
        timestamp=_time(time),
        parent_frame_id=MAP,
        child_frame_id=CAR,
        translation=Vector3(x=place[0], y=place[1], z=place[2]),
        rotation=_turned(heading),
    )


def odometry(time: float, place: Place, heading: float, speed: float) -> Message:
    """Return place and speed [m/s] of our own car."""
    return Odometry(
        timestamp=_time(time),
        frame_id=MAP,
        body_frame_id=CAR,
        pose=_pose(place, heading),
        linear_velocity=Vector3(x=speed),
    )


def poses(time: float, points: Sequence[Place]) -> Message:
    """Return a path; each pose looks at the next point."""
    heads = [math.atan2(b[1] - a[1], b[0] - a[0]) for a, b in pairwise(points)]
    turned = [*heads, heads[-1] if heads else 0.0]
    return PosesInFrame(
        timestamp=_time(time),
        frame_id=MAP,
        poses=[_pose(point, heading) for point, heading in zip(points, turned, strict=True)],
    )


def note(time: float, source: str, text: str, *, warning: bool = False) -> Message:
    """Return a line of the log."""
    level = Log.WARNING if warning else Log.INFO
    return Log(timestamp=_time(time), level=level, name=source, message=text)


def _time(time: float) -> Message:
    seconds, nanos = divmod(stamp(time), NANO)
    return Timestamp(seconds=seconds, nanos=nanos)


def _pose(place: Place, heading: float = 0.0) -> Message:
    position = Vector3(x=place[0], y=place[1], z=place[2])
    return Pose(position=position, orientation=_turned(heading))


def _turned(heading: float) -> Message:
    return Quaternion(z=math.sin(heading / 2.0), w=math.cos(heading / 2.0))


def _point(place: Place) -> Message:
    return Point3(x=place[0], y=place[1], z=place[2])


def _colour(colour: Colour) -> Message:
    red, green, blue, opacity = colour
    return Color(r=red, g=green, b=blue, a=opacity)
