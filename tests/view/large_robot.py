"""Writes a robot of 100 links, 1,000,000 triangles and 5,000 spheres, for measuring foam view.

large_robot.py FOLDER: large.urdf, its 100 meshes, and large.csv. Then

    node browser/speed.mjs CHROMIUM FOAM large.urdf,large.csv
"""
import math
import pathlib
import struct
import sys

LINKS, SPHERES_A_LINK, RINGS, SEGMENTS = 100, 50, 51, 100   # 2 * 100 * 50 triangles a link


def tube(link):
    """A closed tube of 10,000 triangles along z with waves that differ from link to link, as binary STL."""
    def point(ring, segment):
        t, a = ring / (RINGS - 1), 2 * math.pi * segment / SEGMENTS
        r = 0.05 * math.sin(math.pi * t) ** 0.3 * (1 + 0.1 * math.sin(7 * a + link) * math.sin(9 * t)) if 0 < t < 1 else 0
        return r * math.cos(a), r * math.sin(a), 0.2 * t
    triangles = []
    for ring in range(RINGS - 1):
        for s in range(SEGMENTS):
            a, b, c, d = point(ring, s), point(ring, s + 1), point(ring + 1, s + 1), point(ring + 1, s)
            triangles += [(a, b, c), (a, c, d)]
    data = b"".join(struct.pack("<12fH", 0, 0, 0, *a, *b, *c, 0) for a, b, c in triangles)
    return bytes(80) + struct.pack("<I", len(triangles)) + data


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    urdf, rows = ['<robot name="large">'], ["link,x,y,z,radius"]
    for link in range(LINKS):
        (folder / f"link{link}.stl").write_bytes(tube(link))
        mesh = f'<geometry><mesh filename="link{link}.stl"/></geometry>'
        urdf.append(f'<link name="link{link}"><visual>{mesh}</visual><collision>{mesh}</collision></link>')
        if link:
            bend = 0.5 if link % 10 else 1.5
            urdf.append(f'<joint name="joint{link}" type="revolute"><parent link="link{link - 1}"/><child link="link{link}"/>'
                        f'<origin xyz="0 0 0.2" rpy="{bend * (-1) ** (link // 10):.2f} 0 0"/><axis xyz="1 0 0"/>'
                        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>')
        rows += [f"link{link},0,0,{0.2 * (i + 0.5) / SPHERES_A_LINK:.6f},0.06" for i in range(SPHERES_A_LINK)]
    (folder / "large.urdf").write_text("\n".join([*urdf, "</robot>"]))
    (folder / "large.csv").write_text("\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
