"""Solids for link models: lofts, surfaces of revolution, prisms and plates with bores, as polygon meshes.

Lengths are metres. A part is closed and outward oriented unless an argument says otherwise: missing caps, open seams and
T-junctions are made on request, since meshes that come out of CAD programs have them.
"""
import math
from dataclasses import dataclass, field


@dataclass
class Part:
    """A polygon mesh; faces are tuples of vertex indices, counter-clockwise seen from outside."""
    name: str
    vertices: list = field(default_factory=list)
    faces: list = field(default_factory=list)

    def triangles(self):
        """Faces as fans of triangles."""
        for face in self.faces:
            for i in range(1, len(face) - 1):
                yield face[0], face[i], face[i + 1]

    def mapped(self, function):
        return Part(self.name, [function(v) for v in self.vertices], self.faces)

    def moved(self, x, y, z):
        return self.mapped(lambda v: (v[0] + x, v[1] + y, v[2] + z))


def add(a, b):
    return tuple(i + j for i, j in zip(a, b))


def sub(a, b):
    return tuple(i - j for i, j in zip(a, b))


def scaled(a, s):
    return tuple(i * s for i in a)


def dot(a, b):
    return sum(i * j for i, j in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scaled(a, 1 / math.sqrt(dot(a, a)))


def outward(part):
    """The part with its faces turned so that the volume they enclose is positive."""
    volume = sum(dot(part.vertices[a], cross(part.vertices[b], part.vertices[c])) for a, b, c in part.triangles())
    if volume < 0:
        part.faces = [face[::-1] for face in part.faces]
    return part


def to_axis(part, axis, centre=(0, 0, 0)):
    """A part made about z, turned so that z becomes `axis` ('x', '-y', ...), then moved to `centre`."""
    turn = {
        "z": lambda v: v,
        "-z": lambda v: (v[0], -v[1], -v[2]),
        "y": lambda v: (v[0], v[2], -v[1]),
        "-y": lambda v: (v[0], -v[2], v[1]),
        "x": lambda v: (v[2], v[1], -v[0]),
        "-x": lambda v: (-v[2], v[1], v[0]),
    }[axis]
    return part.mapped(turn).moved(*centre)


def band(lower, upper):
    """Quads between two rings of vertex indices of equal length; where a ring has shrunk to one vertex, triangles."""
    count = max(len(lower), len(upper))
    faces = []
    for i in range(count):
        j = (i + 1) % count
        quad = [ring[k % len(ring)] for ring, k in ((lower, i), (lower, j), (upper, j), (upper, i))]
        faces.append(tuple(dict.fromkeys(quad)))
    return faces


def revolve(name, profile, segments, loop=False):
    """The profile [(radius, z), ...] turned about z. `loop`: the profile is closed in itself, which leaves a bore."""
    part = Part(name)
    rings = []
    for radius, z in profile:
        steps = segments if radius > 0 else 1
        rings.append(range(len(part.vertices), len(part.vertices) + steps))
        for i in range(steps):
            angle = 2 * math.pi * i / segments
            part.vertices.append((radius * math.cos(angle), radius * math.sin(angle), z))
    pairs = list(zip(rings, rings[1:])) + ([(rings[-1], rings[0])] if loop else [])
    for lower, upper in pairs:
        part.faces += band(lower, upper)
    return outward(part)


def dome(radius, z, height, steps=4):
    """Profile of a cap from radius at z to the axis at z + height: an elliptic arc, squared off a little."""
    points = []
    for i in range(steps + 1):
        angle = math.pi / 2 * i / steps
        points.append((radius * math.cos(angle) ** 0.7, z + height * math.sin(angle)))
    return points[:-1] + [(0, z + height)]


def catmull_rom(points, steps):
    """The points and `steps` - 1 points between each two of them, on a uniform Catmull-Rom spline."""
    padded = [sub(scaled(points[0], 2), points[1]), *points, sub(scaled(points[-1], 2), points[-2])]
    result = []
    for p0, p1, p2, p3 in zip(padded, padded[1:], padded[2:], padded[3:]):
        for i in range(steps):
            t = i / steps
            result.append(tuple(
                0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t ** 2 + (3 * b - a - 3 * c + d) * t ** 3)
                for a, b, c, d in zip(p0, p1, p2, p3)))
    return result + [points[-1]]


def superellipse(a, b, exponent, segments):
    """Points of |x/a|^n + |y/b|^n = 1, counter-clockwise."""
    points = []
    for i in range(segments):
        angle = 2 * math.pi * i / segments
        cosine, sine = math.cos(angle), math.sin(angle)
        points.append((math.copysign(a * abs(cosine) ** (2 / exponent), cosine),
                       math.copysign(b * abs(sine) ** (2 / exponent), sine)))
    return points


def sections(stations, steps, reference, first, last, segments):
    """Rings of points of a loft; see loft()."""
    path = catmull_rom([(*centre, a, b, n) for centre, a, b, n in stations], steps)
    rings = []
    for i, station in enumerate(path):
        before, after = path[max(i - 1, 0)], path[min(i + 1, len(path) - 1)]
        tangent = unit(sub(after[:3], before[:3]))
        if i == 0 and first:
            tangent = first
        if i == len(path) - 1 and last:
            tangent = last
        u = unit(sub(reference, scaled(tangent, dot(reference, tangent))))
        v = cross(tangent, u)
        rings.append([add(station[:3], add(scaled(u, x), scaled(v, y)))
                      for x, y in superellipse(*station[3:], segments)])
    return rings


def loft(name, stations, segments, reference, steps=3, first=None, last=None, caps=(True, True), seam=0.0):
    """A body of superellipse sections along a curved spine.

    stations: [(centre, half width along the reference direction, half width across it, exponent), ...], splined.
    first, last: normals of the end sections; else the spine's tangent.
    caps: False leaves that end open.
    seam: > 0 leaves the surface open along one side, the two edges that far apart.
    """
    part = Part(name)
    rings = []
    for points in sections(stations, steps, reference, first, last, segments):
        rings.append(list(range(len(part.vertices), len(part.vertices) + segments)))
        part.vertices += points
    for lower, upper in zip(rings, rings[1:]):
        part.faces += band(lower, upper)
    for wanted, ring, turned in ((caps[0], rings[0], True), (caps[1], rings[-1], False)):
        if wanted:
            centre = scaled(tuple(map(sum, zip(*(part.vertices[i] for i in ring)))), 1 / segments)
            part.vertices.append(centre)
            fan = [(ring[i], ring[(i + 1) % segments], len(part.vertices) - 1) for i in range(segments)]
            part.faces += [face[::-1] for face in fan] if turned else fan
    if seam > 0:
        open_seam(part, rings, seam)
    return outward(part)


def open_seam(part, rings, width):
    """Parts the mesh along the first column of the rings: the faces before it get vertices of their own."""
    twin = {}
    for ring in rings:
        first, second = part.vertices[ring[0]], part.vertices[ring[1]]
        twin[ring[0]] = len(part.vertices)
        part.vertices.append(add(first, scaled(unit(sub(second, first)), -width)))
    columns = {ring[-1] for ring in rings}
    part.faces = [tuple(twin.get(i, i) for i in face) if columns & set(face) else face for face in part.faces]


def tube_with_t_junctions(name, radius, coarse, fine, segments):
    """A tube about z from coarse[0] to fine[-1], capped, with twice as many columns from coarse[-1] on.

    There every second vertex of the fine band lies in the middle of an edge of the coarse one: T-junctions.
    """
    part = Part(name)

    def ring(z, count):
        first = len(part.vertices)
        part.vertices += [(radius * math.cos(2 * math.pi * i / count), radius * math.sin(2 * math.pi * i / count), z)
                          for i in range(count)]
        return list(range(first, first + count))

    rings = [ring(z, segments) for z in coarse]
    middles = []
    for i in range(segments):
        a, b = rings[-1][i], rings[-1][(i + 1) % segments]
        middles.append(len(part.vertices))
        part.vertices.append(scaled(add(part.vertices[a], part.vertices[b]), 0.5))
    shared = [i for pair in zip(rings[-1], middles) for i in pair]
    fine_rings = [shared] + [ring(z, 2 * segments) for z in fine]
    for lower, upper in [*zip(rings, rings[1:]), *zip(fine_rings, fine_rings[1:])]:
        part.faces += band(lower, upper)
    part.vertices += [(0, 0, coarse[0]), (0, 0, fine[-1])]
    part.faces += band([len(part.vertices) - 2], rings[0]) + band(fine_rings[-1], [len(part.vertices) - 1])
    return outward(part)


def clip_ears(polygon):
    """Triangles (indices) of a simple polygon, counter-clockwise."""
    def turn(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    rest = list(range(len(polygon)))
    triangles = []
    while len(rest) > 3:
        for k in range(len(rest)):
            i, j, m = rest[k - 1], rest[k], rest[(k + 1) % len(rest)]
            a, b, c = polygon[i], polygon[j], polygon[m]
            inside = any(turn(a, b, polygon[p]) >= 0 and turn(b, c, polygon[p]) >= 0 and turn(c, a, polygon[p]) >= 0
                         for p in rest if p not in (i, j, m))
            if turn(a, b, c) > 0 and not inside:
                triangles.append((i, j, m))
                rest.pop(k)
                break
        else:
            raise ValueError("not a simple counter-clockwise polygon")
    return triangles + [tuple(rest)]


def prism(name, polygon, low, high, chamfer=0.0, ngons=False):
    """A counter-clockwise polygon in x, y raised from z = low to high, its edges at the ends cut by a chamfer.

    ngons: the two ends stay polygons (they must be convex then).
    """
    centre = scaled(tuple(map(sum, zip(*polygon))), 1 / len(polygon))
    extent = min(max(abs(p[k] - centre[k]) for p in polygon) for k in (0, 1))
    shrunk = [add(centre, scaled(sub(p, centre), 1 - chamfer / extent)) for p in polygon]
    layers = [(polygon, low), (polygon, high)]
    if chamfer > 0:
        layers = [(shrunk, low), (polygon, low + chamfer), (polygon, high - chamfer), (shrunk, high)]
    part = Part(name)
    rings = []
    for points, z in layers:
        rings.append(range(len(part.vertices), len(part.vertices) + len(polygon)))
        part.vertices += [(*p, z) for p in points]
    for lower, upper in zip(rings, rings[1:]):
        part.faces += band(lower, upper)
    ends = [tuple(range(len(polygon)))] if ngons else clip_ears(polygon)
    part.faces += [tuple(rings[0][i] for i in reversed(face)) for face in ends]
    part.faces += [tuple(rings[-1][i] for i in face) for face in ends]
    return outward(part)


def box(name, low, high, chamfer=0.0, ngons=False):
    corners = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
    return prism(name, corners, low[2], high[2], chamfer, ngons)


def bored_ring(name, inner, outer, low, high, bores, pitch, bore_radius, columns=4):
    """A flat ring about z with `bores` holes through it, their centres on a circle of radius `pitch`.

    Each sector is a frame of quads between its hole and its outline, four sides of `columns` edges.
    """
    part = Part(name)
    index = {}

    def vertex(point, z):
        key = (round(point[0], 7), round(point[1], 7), z)
        if key not in index:
            index[key] = len(part.vertices)
            part.vertices.append((*point, z))
        return index[key]

    def polar(radius, angle):
        return (radius * math.cos(angle), radius * math.sin(angle))

    half = math.pi / bores
    for k in range(bores):
        middle = 2 * half * k
        centre = polar(pitch, middle)
        outline, hole = [], []
        for side in range(4):
            for i in range(columns):
                t = i / columns
                radius = (outer, outer - (outer - inner) * t, inner, inner + (outer - inner) * t)[side]
                angle = (-half + 2 * half * t, half, half - 2 * half * t, -half)[side]
                outline.append(polar(radius, middle + angle))
                turn = middle + (side - 0.5 + t) * math.pi / 2
                hole.append(add(centre, polar(bore_radius, turn)))
        top, bottom = ([vertex(p, z) for p in outline] for z in (high, low))
        rim, floor = ([vertex(p, z) for p in hole] for z in (high, low))
        part.faces += band(top, rim) + band(rim, floor) + band(floor, bottom)
        for side in (0, 2):   # the outer and the inner wall; the other two sides meet the neighbouring sectors
            span = range(side * columns, (side + 1) * columns)
            for i in span:
                j = (i + 1) % len(top)
                part.faces.append((bottom[i], bottom[j], top[j], top[i]))
    return outward(part)
