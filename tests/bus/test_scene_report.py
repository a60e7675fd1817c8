"""What the car sees reaches those who listen: lights and people, too."""

from sim.scene import EGO, Light, LightState, PersonState, Scene, Signal, VehicleState
from xavi_dialogue.bus.messages import SceneReport, pack, unpack

SCENE = Scene(
    3.0,
    {EGO: VehicleState((0.0, 0.0), 0.0, 8.0, 0.0, 4.8, 1.8)},
    (Light(Signal("north", 3), LightState.STOP_FIRST, 1.5, change_seen=True),),
    {4: PersonState((9.0, 4.0), 1.5, 1.4, 0.2, 0.5)},
)


def test_a_scene_report_shows_the_scene() -> None:
    report = SceneReport(
        ride="r",
        seq=0,
        sim_time=SCENE.time,
        wall_time=0.0,
        vehicles=dict(SCENE.vehicles),
        lights=SCENE.lights,
        people=dict(SCENE.people),
        state="driving",
        speed_factor=1.0,
        plan=(),
        traces=0,
        events=0,
    )
    assert unpack(pack(report), SceneReport).scene() == SCENE


def test_reports_of_before_show_neither_lights_nor_people() -> None:
    text = (
        b'{"schema": "xavi.scene/1", "ride": "r", "seq": 0, "sim_time": 3.0, "wall_time": 0.0,'
        b' "vehicles": {}, "state": "driving", "speed_factor": 1.0, "plan": [], "traces": 0,'
        b' "events": 0}'
    )
    assert unpack(text, SceneReport).scene() == Scene(3.0, {})
