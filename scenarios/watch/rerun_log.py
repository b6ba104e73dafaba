"""A run as an interactive recording for the Rerun viewer: bodies, force, wishes, beliefs, in time.

Rerun is an optional extra: ``pip install 'cowalk[rerun]'``; ``rerun run.rrd`` opens a recording.
"""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgba

from cowalk.sim.basics.errors import InputError, SimulationError
from cowalk.sim.basics.motion import compose
from cowalk.sim.view.scene import Scene
from cowalk.sim.view.shapes import Place, plain_figures, plain_places

from ..export.file import unfinished, writable_file
from ..figures.style import AUTOMATION, HUMAN, HUMAN_FORWARD, MUTED
from .rerun_shapes import archetypes
from .watcher import Filmed, arc_points

if TYPE_CHECKING:
    from cowalk.sim.env.env import CowalkEnv
    from cowalk.sim.world.world import World

    from ..files.schema import Scenario
    from ..trace.trace import Trace

TIMELINE = "time"
FORCE = "#FFC20A"
METRES_PER_NEWTON = 0.1
"""Length of the force arrow."""
EYE = (-3.0, 2.0, 2.3)
"""From where the scene is seen at first, world axes, m; then it follows the base."""
FLUSH = 10.0
"""At least so often what has been logged is written, s of the clock on the wall."""
BACKGROUND = (52, 58, 66)
HANDLE = (0.0, 0.0, 1.0)
"""Where the force is drawn on a plant without a handle, base axes, m."""
FLOOR_HEIGHT = 0.01
"""Height at which wishes are drawn, m."""
WISHES = {
    "true": ("wishes/human/true", "#F0BE9F", 0.05),
    "est": ("wishes/human/believed", HUMAN, 0.02),
    "wish": ("wishes/automation", AUTOMATION, 0.02),
}
"""By prefix of the trace columns: entity, colour and radius in m."""
CURVES: dict[str, tuple[str, str, str]] = {
    "force/forward": ("fx", "forward, N", HUMAN_FORWARD),
    "force/left": ("fy", "left, N", HUMAN),
    "torque/x": ("sensor_torque_x", "about x, N m", "#CC79A7"),
    "torque/y": ("sensor_torque_y", "about y, N m", "#009E73"),
    "torque/z": ("sensor_torque_z", "about z, N m", "#56B4E9"),
    "stubbornness/forward/true": ("true_stubbornness_v", "forward, true", "#F3D08C"),
    "stubbornness/forward/believed": ("est_stubbornness_v", "forward, believed", HUMAN_FORWARD),
    "stubbornness/turning/true": ("true_stubbornness_omega", "turning, true", "#F0BE9F"),
    "stubbornness/turning/believed": ("est_stubbornness_omega", "turning, believed", HUMAN),
    "utility/target": ("target_utility", "target utility", AUTOMATION),
    "speed/forward": ("v", "forward, m/s", "#56B4E9"),
    "speed/turning": ("omega", "turning, rad/s", "#009E73"),
}
"""By entity: trace column, name in the legend, colour."""


class RerunLog:
    """A watcher that writes a recording for the Rerun viewer.

    Until it is finished it is called ``NAME.unfinished.rrd``; one that is there stays until then.

    Parameters
    ----------
    file : str or Path
        Ends in ``.rrd``; its folder is created.

    Raises
    ------
    InputError
        If the file cannot be written, or Rerun is not installed.
    """

    def __init__(self, file: str | Path) -> None:
        self.file = writable_file(file, ".rrd")
        try:
            self._rr: Any = importlib.import_module("rerun")
            self._layout: Any = importlib.import_module("rerun.blueprint")
        except ImportError as error:
            raise InputError(
                "this recording needs Rerun, which is not installed: pip install 'cowalk[rerun]'"
            ) from error
        self._stream: Any = None
        self._scene: Scene | None = None
        self._shown: dict[str, Place] = {}

    def start(self, scenario: Scenario, env: CowalkEnv) -> None:
        """See `Watcher.start`."""
        rr = self._rr
        self._horizon = scenario.automation.negotiation.horizon
        name = f"{scenario.name}, seed {scenario.seed}"
        self._stream = rr.RecordingStream(
            "cowalk",
            recording_id=name,
            send_properties=False,
            # Rows are kept together: a chunk for each would make the file ten times as large.
            batcher_config=rr.ChunkBatcherConfig(flush_tick=FLUSH),
        )
        self._stream.set_log_tick_enabled(False)
        self._stream.set_log_time_enabled(False)
        self._stream.save(unfinished(self.file), default_blueprint=self._blueprint())
        self._still("/", rr.ViewCoordinates.RIGHT_HAND_Z_UP)
        for entity, (_, label, colour) in CURVES.items():
            self._still(entity, rr.SeriesLines(names=label, colors=_rgba(colour), widths=2.0))
        self._ground(env.world)
        plant = env.plant
        if isinstance(plant, Filmed):
            self._handle = plant.handle
            self._scene = Scene(plant.viewer().client)
            shapes = self._scene.shapes
        else:
            self._handle = HANDLE
            shapes = plain_figures(env.world)
        for entity, what in archetypes(rr, shapes):
            self._still(f"world/{entity}", what)
        self._stream.set_time(TIMELINE, duration=0.0)
        self._show_bodies(env)

    def step(self, env: CowalkEnv, trace: Trace) -> None:
        """See `Watcher.step`."""
        row = trace.last()
        rr, log = self._rr, self._stream.log
        self._stream.set_time(TIMELINE, duration=row["t"])
        self._show_bodies(env)
        pose = np.array([row["x"], row["y"], row["theta"]])
        x, y, height = self._handle
        tip = (x + row["fx"] * METRES_PER_NEWTON, y + row["fy"] * METRES_PER_NEWTON, 0.0)
        tail, end = compose(pose, [(x, y, 0.0), tip])
        log(
            "world/force",
            rr.Arrows3D(
                origins=[(*tail[:2], height)],
                vectors=[(*(end - tail)[:2], 0.0)],
                radii=0.02,
                colors=_rgba(FORCE),
            ),
        )
        for prefix, (entity, colour, radius) in WISHES.items():
            wish = np.array([row[f"{prefix}_v"], row[f"{prefix}_omega"]])
            arc = arc_points(pose, wish, self._horizon)
            arc[:, 2] = FLOOR_HEIGHT
            strips = [arc] if np.isfinite(arc).all() else []
            log(f"world/{entity}", rr.LineStrips3D(strips, radii=radius, colors=_rgba(colour)))
        for entity, (column, _, _) in CURVES.items():
            log(entity, rr.Scalars(row[column]))

    def close(self) -> None:
        """See `Watcher.close`."""
        if self._stream is not None:
            self._stream.disconnect()
            self._stream = None
            try:
                unfinished(self.file).replace(self.file)
            except OSError as error:
                what = f"the recording {self.file} cannot be written: {error.strerror}"
                raise SimulationError(what) from error

    def _still(self, entity: str, what: Any) -> None:
        self._stream.log(entity, what, static=True)

    def _blueprint(self) -> Any:
        layout = self._layout
        plots = [
            layout.TimeSeriesView(origin=origin, name=name)
            for origin, name in (
                ("force", "Force on the handle"),
                ("torque", "Torque on the sensor"),
                ("stubbornness", "The human's stubbornness"),
                ("utility", "Utility the automation demands"),
                ("speed", "Speed"),
            )
        ]
        eye = layout.EyeControls3D(
            position=EYE, look_target=(0.5, -0.3, 0.8), tracking_entity="world/base/body"
        )
        scene = layout.Spatial3DView(
            origin="world", name="Scene", eye_controls=eye, line_grid=False, background=BACKGROUND
        )
        return layout.Blueprint(
            layout.Horizontal(scene, layout.Vertical(*plots), column_shares=[3, 2]),
            layout.TimePanel(timeline=TIMELINE, state="collapsed"),
            collapse_panels=True,
        )

    def _ground(self, world: World) -> None:
        rr = self._rr
        points = np.asarray(world.path.points)
        path = np.concatenate((points, np.full((len(points), 1), FLOOR_HEIGHT)), axis=-1)
        self._still("world/path", rr.LineStrips3D([path], radii=0.01, colors=_rgba(MUTED)))
        low, high = points.min(axis=0) - 3.0, points.max(axis=0) + 3.0
        if world.corridor:
            low[1], high[1] = -world.corridor.width / 2.0, world.corridor.width / 2.0
        self._still(
            "world/floor",
            rr.Boxes3D(
                centers=[(*(low + high) / 2.0, -0.02)],
                sizes=[(*(high - low), 0.02)],
                colors=(190, 186, 178),
                fill_mode="solid",
            ),
        )

    def _show_bodies(self, env: CowalkEnv) -> None:
        """Log the place of every part that has moved."""
        if self._scene is not None and isinstance(env.plant, Filmed):
            env.plant.viewer()  # poses what the scene then finds
            places = self._scene.places()
        else:
            places = plain_places(env.plant_state)
        for part, place in places.items():
            if self._shown.get(part) != place:
                self._shown[part] = place
                position, turn = place
                where = self._rr.Transform3D(
                    translation=position, quaternion=self._rr.Quaternion(xyzw=turn)
                )
                self._stream.log(f"world/{part}", where)


def _rgba(colour: str) -> list[int]:
    return [round(255 * share) for share in to_rgba(colour)]
