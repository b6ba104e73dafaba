"""A robot's file from a stranger: no bomb goes off, and nothing but what it names is read."""

import os
import signal

import pytest

from cowalk.sim.basics.errors import InputError
from cowalk.sim.robot.robot import RobotParameters, robot_of

BOMB = "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 9 if n else "ha"}">' for n in range(9))
ROBOT = """{before}<robot name="r"><link name="base">
<inertial><mass value="40"/><inertia ixx="2" iyy="2" izz="2"/></inertial>
<collision><geometry>{shape}</geometry></collision></link>
<link name="handle"/><joint name="j" type="fixed"><origin xyz="-0.4 0 0.9"/>
<parent link="base"/><child link="handle"/></joint>{after}</robot>"""
BOX = '<box size="0.4 0.4 0.9"/>'
CUBE = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1))
CUBE += "f 1 2 3\nf 2 3 4\nf 5 6 7\nf 6 7 8\nf 1 5 2\nf 3 7 4\n"


@pytest.fixture(autouse=True)
def nothing_waits():
    def waited(number, frame):
        raise TimeoutError("it waits for what is no file")

    before = signal.signal(signal.SIGALRM, waited)
    signal.alarm(20)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


def made(folder, shape=BOX, before="", after=""):
    file = folder / "robot.urdf"
    file.write_text(ROBOT.format(shape=shape, before=before, after=after))
    return robot_of(RobotParameters(str(file)), "left", "handle")


def test_the_robot_itself_is_one(tmp_path):
    (tmp_path / "cube.obj").write_text(CUBE)
    assert made(tmp_path).solids
    assert made(tmp_path, '<mesh filename="cube.obj"/>').solids


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (f"<!DOCTYPE r [{BOMB}]>", "&a8;"),
        ('<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/passwd">]>', "&x;"),
        ('<!DOCTYPE r [<!ENTITY % x SYSTEM "http://localhost:9/x"> %x;]>', ""),
    ],
    ids=["bomb", "file", "address"],
)
def test_entities_are_refused(tmp_path, before, after):
    with pytest.raises(InputError, match="it declares entities"):
        made(tmp_path, before=before, after=after)


def test_entities_in_another_encoding_do_no_harm(tmp_path):
    file = tmp_path / "robot.urdf"
    text = ROBOT.format(shape=BOX, before=f"<!DOCTYPE r [{BOMB}]>", after="&a8;")
    file.write_bytes(text.encode("utf-16"))
    with pytest.raises(InputError):
        robot_of(RobotParameters(str(file)), "left", "handle")


def test_a_mesh_makes_no_other_file_be_read(tmp_path):
    os.mkfifo(tmp_path / "waits.mtl")  # whoever opens it waits for ever
    (tmp_path / "cube.obj").write_text(f"mtllib waits.mtl\nmtllib ../../etc/passwd\n{CUBE}")
    assert made(tmp_path, '<mesh filename="cube.obj"/>').solids


@pytest.mark.parametrize(
    "name", ["pipe.stl", "folder.stl", "/dev/zero", "package://../../etc/passwd"]
)
def test_a_mesh_that_is_no_file_is_refused(tmp_path, name):
    os.mkfifo(tmp_path / "pipe.stl")
    (tmp_path / "folder.stl").mkdir()
    with pytest.raises(InputError, match="mesh"):
        made(tmp_path, f'<mesh filename="{name}"/>')


def test_a_mesh_of_a_foreign_file_tells_nothing_of_it(tmp_path):
    (tmp_path / "secret.txt").write_text("user:password\n")
    for name in ("secret.stl", "secret.obj", "secret.dae"):
        (tmp_path / name).unlink(missing_ok=True)
        (tmp_path / name).symlink_to(tmp_path / "secret.txt")
        with pytest.raises(InputError) as refused:
            made(tmp_path, f'<mesh filename="{name}"/>')
        assert "password" not in str(refused.value)
