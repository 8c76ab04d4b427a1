"""load.xacro and write.xacro with the real xacro: arguments, errors, and macros that a user's own file includes."""
import os
import pathlib
import subprocess
import sys
import xml.etree.ElementTree as ET

import pytest
import xacro

CASE = pathlib.Path(os.environ["FOAM_TEST_SOURCE"]) / "tests/cli/robots_in/xacro/arm.urdf.xacro"


def foam(folder, *words):
    """Runs foam where the program xacro is the one of PyPI."""
    path = f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "XDG_CACHE_HOME": str(folder / "cache")}
    command = [os.environ["FOAM_TEST_BINARY"], *map(str, words)]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)


def spheres_of(root):
    """Returns the links with the radii of their spheres."""
    return {
        link.get("name"): [s.get("radius") for s in link.findall("collision/geometry/sphere")]
        for link in root.iter("link")
    }  # fmt: skip


ROD = """<robot name="rod" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arg name="length" default="1"/>
  <link name="rod"><collision><geometry><box size="0.1 0.1 $(arg length)"/></geometry></collision></link></robot>"""


def test_arguments_reach_xacro(tmp_path):
    (tmp_path / "rod.urdf.xacro").write_text(ROD)
    sizes = []
    for length in ("0.4", "0.8"):
        words = ["rod.urdf.xacro", f"length:={length}", "-n", 4, "-m", "octree", "-o", f"{length}.urdf"]
        done = foam(tmp_path, "spherize", *words)
        assert done.returncode == 0, done.stderr
        sizes.append(spheres_of(ET.parse(tmp_path / f"{length}.urdf").getroot()))
    assert sizes[0] != sizes[1]


def test_macros_are_included_into_the_users_file(tmp_path):
    for name in ("arm.urdf", "arm.xacro"):
        done = foam(tmp_path, "spherize", CASE, "-n", 4, "-m", "octree", "-o", name)
        assert done.returncode == 0, done.stderr
    expected = spheres_of(ET.parse(tmp_path / "arm.urdf").getroot())
    links = "".join(f'<link name="{name}"><xacro:{name}_collision/></link>' for name, radii in expected.items() if radii)
    (tmp_path / "mine.xacro").write_text(
        f'<robot name="mine" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="arm.xacro"/>{links}</robot>'
    )
    document = xacro.process_file(str(tmp_path / "mine.xacro"))
    found = spheres_of(ET.fromstring(document.toxml()))
    assert found == {name: radii for name, radii in expected.items() if radii}
    assert found


@pytest.mark.parametrize("text, said", [
    ('<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><link name="${none}"/></robot>', "none"),
    ('<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="no.xacro"/></robot>', "no.xacro"),
])  # fmt: skip
def test_errors_are_those_of_xacro(tmp_path, text, said):
    (tmp_path / "wrong.xacro").write_text(text)
    done = foam(tmp_path, "spherize", "wrong.xacro", "-n", 4, "-o", "out.urdf")
    assert done.returncode == 1
    assert "wrong.xacro: xacro fails:" in done.stderr and said in done.stderr
    assert not (tmp_path / "out.urdf").exists()
