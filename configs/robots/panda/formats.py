"""Binary STL, Wavefront OBJ and COLLADA, written the same on every machine: coordinates are rounded to a micrometre."""
import math
import re
import struct


def number(value):
    """Six decimals, without a negative zero."""
    return f"{round(value, 6) + 0.0:.6f}"


def stl(parts, title):
    """Triangles with corners of their own; normals left to the reader (0 0 0), as the format allows."""
    triangles = [[part.vertices[i] for i in face] for part in parts for face in part.triangles()]
    data = title.encode("ascii").ljust(80, b" ") + struct.pack("<I", len(triangles))
    for corners in triangles:
        values = [float(number(x)) for corner in corners for x in corner]
        data += struct.pack("<12fH", 0, 0, 0, *values, 0)
    return data


def obj(parts, title):
    """One group a part; faces as polygons."""
    lines = [f"# {title}"]
    base = 1
    for part in parts:
        lines.append(f"g {part.name}")
        lines += ["v " + " ".join(map(number, v)) for v in part.vertices]
        lines += ["f " + " ".join(str(i + base) for i in face) for face in part.faces]
        base += len(part.vertices)
    return ("\n".join(lines) + "\n").encode("ascii")


def dae_geometry(part):
    triangles = list(part.triangles())
    positions = " ".join(number(x) for v in part.vertices for x in v)
    indices = " ".join(str(i) for face in triangles for i in face)
    return f"""    <geometry id="{part.name}" name="{part.name}">
      <mesh>
        <source id="{part.name}-positions">
          <float_array id="{part.name}-array" count="{3 * len(part.vertices)}">{positions}</float_array>
          <technique_common>
            <accessor source="#{part.name}-array" count="{len(part.vertices)}" stride="3">
              <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
            </accessor>
          </technique_common>
        </source>
        <vertices id="{part.name}-vertices">
          <input semantic="POSITION" source="#{part.name}-positions"/>
        </vertices>
        <triangles count="{len(triangles)}">
          <input semantic="VERTEX" source="#{part.name}-vertices" offset="0"/>
          <p>{indices}</p>
        </triangles>
      </mesh>
    </geometry>
"""


def dae_node(name, transforms, children):
    inner = "".join(f"        {line}\n" for line in [*transforms, *children])
    return f"      <node id=\"node-{name}\" name=\"{name}\">\n{inner}      </node>\n"


def dae(parts, nodes, title):
    """`nodes`: [(name, [transform elements], [names of parts or nested node texts])]; Z up, metres."""
    geometries = "".join(map(dae_geometry, parts))
    scene = "".join(dae_node(name, transforms, [f'<instance_geometry url="#{part}"/>' for part in instances])
                    for name, transforms, instances in nodes)
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <contributor><comments>{title}</comments></contributor>
    <created>2026-01-01T00:00:00Z</created>
    <modified>2026-01-01T00:00:00Z</modified>
    <unit name="meter" meter="1"/>
    <up_axis>Z_UP</up_axis>
  </asset>
  <library_geometries>
{geometries}  </library_geometries>
  <library_visual_scenes>
    <visual_scene id="scene">
{scene}    </visual_scene>
  </library_visual_scenes>
  <scene>
    <instance_visual_scene url="#scene"/>
  </scene>
</COLLADA>
""".encode("ascii")


def transform(text):
    """Returns the map of one transform of COLLADA."""
    kind, numbers = re.fullmatch(r"<(\w+)>(.*)</\w+>", text).groups()
    x, y, z, *more = map(float, numbers.split())
    if kind == "translate":
        return lambda v: (v[0] + x, v[1] + y, v[2] + z)
    if kind == "scale":
        return lambda v: (v[0] * x, v[1] * y, v[2] * z)
    if kind == "matrix":
        rows = [x, y, z, *more]
        return lambda v: tuple(sum(rows[4 * i + k] * v[k] for k in range(3)) + rows[4 * i + 3] for i in range(3))
    assert (kind, x, y, z) == ("rotate", 1, 0, 0), text
    c, s = round(math.cos(math.radians(more[0])), 12), round(math.sin(math.radians(more[0])), 12)
    return lambda v: (v[0], c * v[1] - s * v[2], s * v[1] + c * v[2])


def placed(parts, nodes):
    """Returns the parts where the nodes of a scene put them."""
    result = []
    for node, transforms, instances in nodes:
        for part in (part for part in parts if part.name in instances):
            for one in reversed(transforms):
                part = part.mapped(transform(one))
            part.name = f"{node}_{part.name}"
            result.append(part)
    return result
