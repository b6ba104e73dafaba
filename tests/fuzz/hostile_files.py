"""Robots, recordings and left-over runs as attackers would write them: read, walked with, filmed.

``python tests/fuzz/hostile_files.py FOLDER FIRST COUNT`` prints the number of each case before
it begins and what came of it after, so that whoever started it knows which one ended the process.
"""

from __future__ import annotations

import faulthandler
import os
import random
import sys
import sysconfig
from pathlib import Path

LIMIT = 20.0
"""A case that takes longer hangs, s."""

BOX = """v 0 0 0
v 0.2 0 0
v 0 0.2 0
v 0 0 0.2
f 1 2 3
f 1 2 4
f 1 3 4
f 2 3 4
"""
ROBOT = """<robot name="own">
<material name="m"><color rgba="0.5 0.5 0.5 1"/></material>
<link name="base"><inertial><mass value="30"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0"
 iyz="0"/></inertial>
<collision><origin xyz="0 0 0.2" rpy="0 0 0"/><geometry><box size="0.4 0.3 0.4"/></geometry>
</collision>
<visual><origin xyz="0 0 0.2" rpy="0 0 0"/><geometry><mesh filename="part.MESH" scale="1 1 1"/>
</geometry><material name="m"/></visual></link>
<link name="handle"/>
<joint name="j" type="fixed"><parent link="base"/><child link="handle"/>
<origin xyz="0.15 -0.3 1.04" rpy="0 0 0"/></joint>
</robot>
"""
SECRET = "root:x:0:0:secret"
NUMBERS = ["nan", "inf", "-1", "0", "1e308", "-1e308", "1e-320", "99999999999999999999", "", "x"]
NAMES = [
    "../secret.txt",
    "SECRET",
    "file:///etc/passwd",
    "/dev/zero",
    "/dev/stdin",
    "pipe.obj",
    ".",
]


def meshes() -> dict[str, bytes]:
    """Return a good mesh of every kind that is drawn, by its ending."""
    import trimesh

    box = trimesh.creation.box((0.2, 0.2, 0.2))
    return {
        "obj": BOX.encode(),
        "stl": bytes(box.export(file_type="stl")),
        "dae": bytes(box.export(file_type="dae")),
    }


def hurt_mesh(dice: random.Random, kind: str, data: bytes) -> bytes:
    """Return a mesh that somebody has tampered with."""
    way = dice.randrange(9)
    if way == 0:
        return b""
    if way == 1:
        return data[: dice.randrange(len(data))]
    if way == 2:
        return bytes(byte if dice.random() > 0.02 else dice.randrange(256) for byte in data)
    if way == 3:
        return data + data[: dice.randrange(len(data))]
    if kind == "stl":
        count = dice.choice([0, 1, 2**31 - 1, 2**32 - 1, 13])
        return data[:80] + count.to_bytes(4, "little") + data[84:]
    if kind == "obj" and way < 7:
        more = [
            *(
                "f 1 2 99",
                "f -1 -2 -99",
                "f 0 0 0",
                "f 1",
                "f 1/9/9 2/9/9 3/9/9",
                "f 1//9 2//9 3//9",
            ),
            *("mtllib SECRET", "mtllib ../secret.txt", "usemtl x", "f 2147483648 1 2", "v nan 0 0"),
            *("v 1e308 1e308 1e308\nf 1 2 5", "l 1 2 3", "f " + "1 " * 5000, "o " + "x" * 9000),
        ]
        return data + "\n".join(dice.choices(more, k=dice.randint(1, 3))).encode() + b"\n"
    words = data.split()
    place = dice.randrange(len(words))
    value = dice.choice(NUMBERS).encode()
    if kind == "dae" and dice.random() < 0.3:
        return data.replace(dice.choice([b"<p>", b"<source", b"count=", b"<vertices"]), b"<q ", 1)
    return data.replace(words[place], value, dice.choice([1, -1]))


def hurt_robot(dice: random.Random, text: str) -> str:
    """Return a robot that somebody has tampered with."""
    way = dice.randrange(8)
    if way == 0:
        return text[: dice.randrange(len(text))]
    if way == 1:
        return text.replace("part.MESH", dice.choice(NAMES))
    if way == 2:
        entity = '<!DOCTYPE r [<!ENTITY e SYSTEM "file://SECRET">]>'
        return entity + text.replace('name="own">', 'name="own">&e;')
    if way == 3:
        bombs = "".join(f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, 10))
        return f'<!DOCTYPE r [<!ENTITY e0 "x">{bombs}]>' + text.replace("own", "&e9;")
    if way == 4:
        depth = dice.choice([10, 500, 20_000])
        return text.replace("</robot>", "<a>" * depth + "</a>" * depth + "</robot>")
    if way == 5:
        texture = f'<texture filename="{dice.choice(NAMES)}"/>'
        return text.replace('<color rgba="0.5 0.5 0.5 1"/>', texture)
    tokens = text.split('"')
    place = 2 * dice.randrange(len(tokens) // 2) + 1
    tokens[place] = dice.choice([*NUMBERS, "base", "handle", "x" * 9000, "1 2 3", "\u00e9\u202e"])
    return '"'.join(tokens)


def recordings() -> dict[str, bytes]:
    """Return a good recording, and a trace that a killed run has left, by their endings."""
    import io

    import numpy as np
    import pyarrow as pa
    import pyarrow.parquet as pq

    from cowalk.scenarios.trace.trace import FORMAT

    time = np.arange(400) * 0.01
    columns = {"t_s": time, "fx_n": np.sin(time), "fy_n": np.cos(time)}
    rows = np.stack(list(columns.values()), axis=-1)
    files = {name: io.BytesIO() for name in ("csv", "npz", "parquet", "arrow")}
    np.savetxt(files["csv"], rows, delimiter=",", header="t_s,fx_n,fy_n", comments="", fmt="%.4f")
    np.savez(files["npz"], **columns)
    table = pa.table(columns)
    pq.write_table(table, files["parquet"])
    fields = [pa.field(name, pa.float64(), metadata={"unit": "1"}) for name in ("t", "x", "y")]
    schema = pa.schema(fields, metadata={"cowalk.format": str(FORMAT)})
    with pa.ipc.new_stream(files["arrow"], schema) as out:
        for batch in table.rename_columns(["t", "x", "y"]).cast(schema).to_batches(100):
            out.write_batch(batch)
    return {name: file.getvalue() for name, file in files.items()}


def hurt_recording(dice: random.Random, kind: str, data: bytes) -> bytes:
    """Return a recording that somebody has tampered with."""
    way = dice.randrange(6)
    if way == 0:
        return data[: dice.randrange(len(data))]
    if way == 1:
        return bytes(byte if dice.random() > 0.01 else dice.randrange(256) for byte in data)
    if way == 2:
        place = dice.randrange(len(data))
        return data[:place] + dice.randbytes(dice.randrange(1, 9)) + data[place:]
    if way == 3:
        place = dice.randrange(len(data) - 8)
        huge = dice.choice([2**31 - 1, 2**32 - 1, 2**63 - 1]).to_bytes(8, "little")
        return data[:place] + huge + data[place + 8 :]
    if kind == "csv":
        words = data.replace(b"\n", b",").split(b",")
        return data.replace(dice.choice(words), dice.choice(NUMBERS).encode(), 1)
    return data + data if way == 4 else b""


def replay(file: Path) -> str:
    """Read a recording, or what a run has left; return what came of it."""
    from cowalk.scenarios import load, run
    from cowalk.scenarios.trace.stream import read_stream
    from cowalk.sim.basics.errors import InputError

    parts = ["human:={name: recorded, parameters: {file: " + f"'{file}'" + "}}", "plant=unicycle"]
    try:
        if file.suffix == ".arrow":
            return f"read {len(read_stream(file))} rows"
        result = run(load("walk", [*parts, "duration=0.5", "expect={}"]))
    except InputError as refusal:
        if "\n" in str(refusal):
            raise AssertionError(f"more than one line: {refusal}") from refusal
        return f"refused: {refusal}"
    if result.fault is not None:
        raise AssertionError(result.fault)
    return f"walked {len(result.trace)} steps, {result.error}"


def make(folder: Path, number: int, good: dict[str, bytes]) -> Path:
    """Write a case and return its file."""
    dice = random.Random(number)
    kind = dice.choice(list(good))
    here = folder / str(number)
    here.mkdir(parents=True)
    secret = folder / "secret.txt"
    secret.write_text(SECRET)
    if kind in ("csv", "npz", "parquet", "arrow"):
        file = here / f"own.{kind}"
        file.write_bytes(hurt_recording(dice, kind, good[kind]))
        return file
    os.mkfifo(here / "pipe.obj")
    mesh, robot = good[kind], ROBOT.replace("MESH", kind)
    both = dice.random()
    if both < 0.7:
        mesh = hurt_mesh(dice, kind, mesh)
    if both > 0.6:
        robot = hurt_robot(dice, ROBOT if both > 0.8 else robot)
    (here / f"part.{kind}").write_bytes(mesh.replace(b"SECRET", str(secret).encode()))
    text = robot.replace("part.MESH", f"part.{kind}").replace("SECRET", str(secret))
    (here / "own.urdf").write_text(text, encoding="utf-8")
    return here / "own.urdf"


def watch_files(folder: Path) -> list[str]:
    """Note every file that Python opens from now on and that is none of a case's business."""
    import tempfile

    foreign: list[str] = []
    allowed = [str(Path(__file__).parents[2]), sys.prefix, sys.base_prefix, "/dev/null", "/proc"]
    allowed += [*sysconfig.get_paths().values(), f"{tempfile.gettempdir()}/", "/sys"]

    def note(event: str, arguments: tuple[object, ...]) -> None:
        if event != "open" or not isinstance(arguments[0], str | bytes | os.PathLike):
            return
        name = os.path.abspath(os.fsdecode(arguments[0]))
        if name == str(folder / "secret.txt") or not any(
            name.startswith(place) for place in allowed
        ):
            foreign.append(name)

    sys.addaudithook(note)
    return foreign


def film(urdf: os.PathLike[str]) -> str:
    """Read a robot, walk a step with it, look at it; return what came of it."""
    import numpy as np

    from cowalk.sim.basics.errors import InputError
    from cowalk.sim.basics.path import Path
    from cowalk.sim.basics.rates import Rates
    from cowalk.sim.plant.registry import PLANTS
    from cowalk.sim.robot.robot import RobotParameters
    from cowalk.sim.world.world import World

    try:
        plant = PLANTS.get("bullet")(rates=Rates(), robot=RobotParameters(urdf=str(urdf)))
    except InputError as refusal:
        if "\n" in str(refusal):
            raise AssertionError(f"more than one line: {refusal}") from refusal
        if SECRET in str(refusal):
            raise AssertionError(f"tells a secret: {refusal}") from refusal
        return f"refused: {refusal}"
    try:
        plant.reset(World(Path(((0.0, 0.0), (5.0, 0.0)))), np.random.default_rng(0))
        plant.step((0.5, 0.0), (1.0, 0.0))
        viewer = plant.viewer()
        viewer.look(viewer.camera("chase", 96, 72))
    finally:
        plant.close()
    return "filmed"


def main() -> None:
    """Go through the cases that the command line names."""
    folder, first, count = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    good = meshes() | recordings()
    out = os.fdopen(os.dup(1), "w", encoding="utf-8", errors="backslashreplace")
    cases = [(number, make(folder, number, good)) for number in range(first, first + count)]
    foreign = watch_files(folder)
    for number, case in cases:
        print(number, end=" ", file=out, flush=True)
        faulthandler.dump_traceback_later(LIMIT, exit=True)
        try:
            came = film(case) if case.suffix == ".urdf" else replay(case)
        except BaseException as failure:
            came = f"{type(failure).__name__}: {' '.join(str(failure).split())[:300]}"
        faulthandler.cancel_dump_traceback_later()
        if foreign:
            came = f"read {foreign}"
            foreign.clear()
        print(came.encode("unicode_escape").decode(), file=out, flush=True)


if __name__ == "__main__":
    main()
