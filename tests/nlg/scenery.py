"""A scene to speak of: a red lorry ahead (1) that was behind us, two blue cars (2, 3)."""

from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.vocabulary import Bearing, Kind
from xavi_dialogue.nlg.context import SpeechContext

NOW = 20.0


def look(
    vehicle: int,
    time: float,
    kind: Kind,
    colour: str | None,
    bearing: Bearing,
    distance: float = 10.0,
    **more: object,
) -> Look:
    settings = {"alone": True, "speed": 10.0, **more}
    return Look(vehicle, time, kind, colour, 4.5, bearing, distance, 5.0, 3.0, **settings)  # type: ignore[arg-type]


LORRY = look(1, NOW, "truck", "red", "ahead-left")
LORRY_THEN = look(1, 5.0, "truck", "red", "behind", 30.0)
BLUE = look(2, NOW, "car", "blue", "oncoming", 25.0, alone=False)
OTHER_BLUE = look(3, NOW, "car", "blue", "behind", 12.0, alone=False)
GONE = look(4, NOW, "bus", None, "behind", 40.0, in_view=False, seen=12.0)
LOOKS = {
    (1, NOW): LORRY,
    (1, 5.0): LORRY_THEN,
    (2, NOW): BLUE,
    (3, NOW): OTHER_BLUE,
    (4, NOW): GONE,
}
CONTEXT = SpeechContext(now=NOW, looks=LOOKS)
