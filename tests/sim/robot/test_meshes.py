"""Meshes from strangers: refused in one line, or handed to the engine as plain triangles."""

import numpy as np
import pytest

from cowalk.sim.basics.errors import InputError
from cowalk.sim.robot.robot import RobotParameters, robot_of
from cowalk.sim.urdf.meshes import copy_meshes, read_mesh

ROBOT = """<robot name="own"><link name="base"><inertial><mass value="30"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><box size="0.4 0.3 0.4"/></geometry></collision>
<visual><geometry><mesh filename="part.{kind}" scale="2 2 2"/></geometry>
<material name="m"><texture filename="/etc/passwd"/></material></visual></link>
<link name="handle"/><joint name="j" type="fixed"><parent link="base"/><child link="handle"/>
<origin xyz="0.15 -0.3 1.04"/></joint></robot>"""
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
EMPTY = (
    '<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" '
    'version="1.4.1"><asset/></COLLADA>'
)


def robot(folder, kind, mesh):
    (folder / f"part.{kind}").write_text(mesh)
    (folder / "own.urdf").write_text(ROBOT.format(kind=kind))
    return robot_of(RobotParameters(str(folder / "own.urdf")), "left", "handle")


@pytest.mark.parametrize(
    ("kind", "mesh", "said"),
    [
        ("obj", OBJ + "f 1 2 9\n", "cannot be read: IndexError"),
        ("obj", OBJ + "v 1e30 0 0\nf 1 2 4\n", "corners beyond 1e\\+06"),
        ("obj", "", "triangles with finite corners|cannot be read"),
        ("dae", EMPTY, "triangles with finite corners|cannot be read"),
        ("stl", "solid x\nendsolid x\n", "triangles with finite corners|cannot be read"),
    ],
)
def test_a_mesh_that_would_end_the_engine_is_refused_though_it_is_only_seen(
    tmp_path, kind, mesh, said
):
    with pytest.raises(InputError, match=f"^robot: link 'base': mesh .*({said})"):
        robot(tmp_path, kind, mesh)


def test_who_draws_gets_the_same_triangles_and_no_other_name(tmp_path):
    own = robot(tmp_path, "obj", "mtllib /etc/passwd\n" + OBJ)
    assert "/etc/passwd" not in own.urdf
    copies = tmp_path / "copies"
    copies.mkdir()
    copied = copy_meshes(own.urdf, str(copies))
    (copy,) = copies.iterdir()
    assert str(copy) in copied
    assert str(tmp_path / "part.obj") not in copied
    vertices, faces = read_mesh(str(copy))
    np.testing.assert_array_equal(vertices[faces].sum(axis=1), [[1.0, 1.0, 0.0]])


def test_a_mesh_that_has_changed_is_read_again(tmp_path):
    file = tmp_path / "part.obj"
    file.write_text(OBJ)
    assert read_mesh(str(file))[0].max() == 1.0
    file.write_text(OBJ.replace("v 1 0 0", "v 10 0 0"))
    assert read_mesh(str(file))[0].max() == 10.0
