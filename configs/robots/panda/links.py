"""The links of the Panda, each in its joint's frame (modified Denavit-Hartenberg, as Franka documents them).

Joint axes and offsets come from the kinematics; diameters and outlines follow overall sizes, rounded. Bodies overlap as
parts of an assembly do; what is called hidden lies inside another part.
"""
import math

from shapes import bored_ring, box, dome, loft, prism, revolve, to_axis, tube_with_t_junctions

TUBE = 0.055        # radius of the joint tubes
HOUSING = 0.0545    # radius of the joint housings
X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def housing(name, axis, centre, back, front, radius=HOUSING, cap=0.045, segments=24):
    """A joint housing along `axis`: a rounded cap at `back`, a face with a blind bore at `front` (both along the axis)."""
    profile = [(0, front - 0.008), (0.018, front - 0.008), (0.018, front), (radius - 0.005, front),
               (radius, front - 0.005), *dome(radius, back + cap, -cap)]
    return to_axis(revolve(name, profile, segments), axis, centre)


def seal(name, axis, centre, at, radius, segments=24):
    """The ring between two links: a flat torus of rectangular section, standing out by a millimetre."""
    profile = [(radius - 0.012, at - 0.003), (radius + 0.001, at - 0.003), (radius + 0.001, at + 0.003),
               (radius - 0.012, at + 0.003)]
    return to_axis(revolve(name, profile, segments, loop=True), axis, centre)


def screw(name, axis, centre, radius=0.004, height=0.003):
    """The head of a screw: six sides, its foot inside the body."""
    return to_axis(revolve(name, [(0, -height), (radius, -height), (radius, height), (0, height)], 6), axis, centre)


def link0():
    outline = [(0.0700, 0.0), (0.0655, 0.0300), (0.0520, 0.0550), (0.0280, 0.0780), (0.0120, 0.0925), (-0.0100, 0.0946),
               (-0.0450, 0.0935), (-0.0600, 0.0850), (-0.0820, 0.0680), (-0.1380, 0.0620), (-0.1500, 0.0520),
               (-0.1541, 0.0300)]
    outline += [(x, -y) for x, y in reversed(outline[1:])]
    parts = [prism("base_plate", outline, 0.0, 0.018, chamfer=0.004)]
    parts.append(revolve("pedestal", [(0, 0.002), (0.0716, 0.002), (0.0716, 0.030), (0.0680, 0.060), (0.0625, 0.090),
                                      (0.0580, 0.115), (0.0560, 0.134), (0.0530, 0.1400), (0.0300, 0.1400),
                                      (0.0300, 0.1320), (0, 0.1320)], 28))
    hump = [((-0.1520, 0, 0.017), 0.050, 0.014, 4), ((-0.1400, 0, 0.022), 0.056, 0.018, 4),
            ((-0.1150, 0, 0.034), 0.059, 0.032, 3.5), ((-0.0800, 0, 0.050), 0.060, 0.047, 3.5),
            ((-0.0450, 0, 0.062), 0.058, 0.060, 3), ((-0.0100, 0, 0.066), 0.050, 0.062, 3)]
    parts.append(loft("rear", hump, 20, Y, steps=3, first=X, last=X))
    lobe = [(0.0035, 0.001), (0.0175, 0.001), (0.0175, 0.010), (0.0150, 0.012), (0.0035, 0.012)]
    for name, x, y in (("foot_left", -0.120, 0.062), ("foot_right", -0.120, -0.062)):
        parts.append(revolve(name, lobe, 16, loop=True).moved(x, y, 0))
    parts.append(box("connector", (-0.1535, -0.022, 0.010), (-0.1300, 0.022, 0.0300), 0.002))
    parts += [screw(f"screw_{i}", "z", (x, y, 0.018)) for i, (x, y) in enumerate(((-0.012, 0.083), (-0.012, -0.083)))]
    return parts


def shoulder(prefix, foot):
    """What links 1 and 2 share, in the frame of link 1: the tube comes up z and turns into a housing along y.

    foot: whether the bend is closed where it stands in the tube.
    """
    spine = [((0, 0, -0.150), 0.0530, 0.0530, 2), ((0, -0.002, -0.120), 0.0550, 0.0560, 2),
             ((0, -0.022, -0.078), 0.0540, 0.0600, 2.2), ((0, -0.048, -0.040), 0.0520, 0.0580, 2.3),
             ((0, -0.066, -0.002), 0.0480, 0.0480, 2.3)]
    return [loft(f"{prefix}_bend", spine, 20, X, steps=3, first=Z, caps=(foot, True)),
            housing(f"{prefix}_housing", "y", (0, 0, 0), -0.1290, -0.0035),
            seal(f"{prefix}_seal", "y", (0, 0, 0), -0.0030, 0.0500)]


def link1():
    tube = [(0, -0.186), (0.030, -0.186), (0.030, -0.192), (0.0525, -0.192), (TUBE, -0.1895), (TUBE, -0.165),
            (TUBE, -0.140), (0, -0.140)]
    mark = loft("lettering", [((0.040, -0.030, -0.060), 0.010, 0.016, 5), ((0.0545, -0.030, -0.060), 0.009, 0.015, 5)],
                16, Y, steps=1)
    return [revolve("tube", tube, 28), *shoulder("shoulder", True), mark]


def link2():
    """The shoulder turned by a quarter: (x, y, z) of link 1 becomes (x, z, -y)."""
    tube = tube_with_t_junctions("tube", TUBE, [-0.130, -0.150], [-0.168, -0.194], 20)
    parts = [tube, *shoulder("arm", False), seal("tube_seal", "z", (0, 0, 0), -0.172, TUBE)]
    return [part.mapped(lambda v: (v[0], v[2], -v[1])) for part in parts]


def link3():
    tube = [(0, -0.115), (0.030, -0.115), (0.030, -0.121), (0.0525, -0.121), (TUBE, -0.1185), (TUBE, -0.095),
            (TUBE, -0.075), (0, -0.075)]
    spine = [((0, 0, -0.085), 0.0530, 0.0530, 2), ((0.006, 0.006, -0.060), 0.0550, 0.0550, 2),
             ((0.030, 0.026, -0.030), 0.0550, 0.0540, 2.1), ((0.058, 0.046, -0.008), 0.0520, 0.0500, 2.2),
             ((0.0800, 0.056, 0.004), 0.0440, 0.0440, 2.2)]
    return [revolve("tube", tube, 28), loft("elbow", spine, 20, Y, steps=3, first=Z),
            housing("elbow_housing", "y", (0, 0, 0), 0, 0.1075).mapped(lambda v: (v[0], 0.1110 - v[1], -v[2])),
            seal("elbow_seal", "z", (0, 0, 0), 0.0, 0.0500)]


def link3_nodes():
    """Tube and elbow sit in the link's frame; the housing and its seal are placed, and turned, by their nodes."""
    return [("tube", [], ["tube", "elbow"]),
            ("elbow", ["<translate>0.0825 0 0</translate>"], ["elbow_housing"]),
            ("elbow_ring", ["<translate>0.0825 0.003 0</translate>", "<rotate>1 0 0 -90</rotate>"], ["elbow_seal"]),
            ("tube_ring", ["<matrix>1.09 0 0 0  0 1.09 0 0  0 0 1 -0.0985  0 0 0 1</matrix>"], ["elbow_seal"])]


def link4():
    tube = [(0, 0.118), (0.030, 0.118), (0.030, 0.124), (0.0525, 0.124), (TUBE, 0.1215), (TUBE, 0.100), (TUBE, 0.078),
            (0, 0.078)]
    spine = [((-0.0825, 0.088, 0), 0.0530, 0.0530, 2), ((-0.0770, 0.064, 0.006), 0.0550, 0.0550, 2),
             ((-0.0550, 0.034, 0.028), 0.0550, 0.0540, 2.1), ((-0.0260, 0.010, 0.046), 0.0520, 0.0500, 2.2),
             ((-0.0025, -0.004, 0.056), 0.0440, 0.0440, 2.2)]
    return [to_axis(revolve("tube", tube, 28), "y", (0, 0, 0)).mapped(lambda v: (v[0] - 0.0825, v[1], v[2])),
            loft("elbow", spine, 20, Z, steps=3, first=(0, -1, 0), caps=(False, True), seam=0.00004),
            housing("elbow_housing", "-z", (0, 0, 0), -0.1110, -0.0035),
            seal("elbow_seal", "z", (0, 0, 0), 0.0030, 0.0500)]


def link5():
    spine = [((0, 0, -0.2420), 0.0530, 0.0530, 2), ((0, 0.004, -0.2150), 0.0550, 0.0575, 2),
             ((0, 0.022, -0.1750), 0.0535, 0.0560, 2.2), ((0, 0.048, -0.1200), 0.0505, 0.0470, 2.4),
             ((0, 0.066, -0.0600), 0.0480, 0.0440, 2.5), ((0, 0.070, -0.0050), 0.0450, 0.0420, 2.4)]
    cap = [(0, -0.2640), (0.0520, -0.2640), (TUBE, -0.2610), (TUBE, -0.2450), (TUBE, -0.2300), (0, -0.2300)]
    ridge = [((0, -0.044, -0.2200), 0.018, 0.010, 3), ((0, -0.026, -0.1750), 0.020, 0.012, 3),
             ((0, 0.004, -0.1200), 0.019, 0.012, 3), ((0, 0.024, -0.0600), 0.017, 0.012, 3),
             ((0, 0.036, -0.0150), 0.015, 0.012, 3)]
    return [revolve("collar", cap, 28), loft("forearm", spine, 20, X, steps=3, first=Z, caps=(False, False)),
            loft("cable_duct", ridge, 12, X, steps=2),
            housing("wrist_housing", "y", (0, 0, 0), 0, 0.1235, radius=0.0515, cap=0.040).mapped(
                lambda v: (v[0], 0.1300 - v[1], -v[2])),
            seal("wrist_seal", "y", (0, 0, 0), 0.0060, 0.0470)]


def link6():
    body = [((0.004, 0, 0.0260), 0.0440, 0.0225, 2.6), ((0.030, 0.006, 0.0200), 0.0450, 0.0290, 2.6),
            ((0.060, 0.012, 0.0100), 0.0450, 0.0330, 2.5), ((0.088, 0.014, 0.0020), 0.0400, 0.0330, 2.4)]
    axis7 = revolve("flange_housing", [(0, -0.043), (0.0180, -0.043), (0.0180, -0.051), (0.0400, -0.051),
                                       (0.0440, -0.047), *dome(0.0440, 0.0460, 0.0357)], 24)
    axis6 = revolve("wrist_housing", [(0, 0.002), (0.0180, 0.002), (0.0180, -0.004), (0.0450, -0.004), (0.0480, 0),
                                      *dome(0.0480, 0.0220, 0.0343)], 24)
    return [axis6, loft("bridge", body, 20, Y, steps=3, first=X, caps=(False, False)), axis7,
            seal("seal", "z", (0, 0, 0), 0.0, 0.0440)]


def link6_nodes():
    """The housing of axis 7 stands along y at a7 = 0.088; one seal serves both axes."""
    return [("wrist", [], ["wrist_housing", "bridge"]),
            ("axis_7", ["<translate>0.088 0 0</translate>", "<rotate>1 0 0 -90</rotate>"], ["flange_housing"]),
            ("seal_6", ["<translate>0 0 -0.003</translate>"], ["seal"]),
            ("seal_7", ["<translate>0.088 -0.046 0</translate>", "<rotate>1 0 0 90</rotate>",
                        "<scale>0.93 0.93 1</scale>"], ["seal"])]


def link7():
    """Housing, the tool flange (31.5 mm radius, four bores on 25 mm), and the lug with the two guiding buttons."""
    body = [(0, 0.0600), (0.0180, 0.0600), (0.0180, 0.0520), (0.0400, 0.0520), (0.0440, 0.0560), (0.0440, 0.0925),
            (0.0420, 0.0965), (0.0320, 0.0980), (0.0100, 0.0980), (0.0100, 0.0900), (0, 0.0900)]
    slant = math.sqrt(0.5)
    lug = [((0.016, 0.016, 0.0800), 0.0340, 0.0170, 4), ((0.036, 0.036, 0.0830), 0.0370, 0.0160, 4),
           ((0.050, 0.050, 0.0850), 0.0330, 0.0130, 4), ((0.0625, 0.0625, 0.0860), 0.0240, 0.0105, 3.5)]
    lug = loft("lug", lug, 20, (slant, -slant, 0), steps=3, first=(slant, slant, 0), last=(slant, slant, 0))
    buttons = [to_axis(revolve(f"button_{i}", [(0, -0.004), (0.0075, -0.004), (0.0075, 0.002), (0.0060, 0.003),
                                               (0, 0.003)], 16), "z", place)
               for i, place in enumerate(((0.0440, 0.0620, 0.0960), (0.0620, 0.0440, 0.0960)))]
    flange = bored_ring("flange", 0.0100, 0.0315, 0.0965, 0.1068, 4, 0.0250, 0.0032)
    return [revolve("housing", body, 28), lug, *buttons, flange]


def hand():
    shell = [((0, -0.002, 0.0040), 0.0300, 0.0920, 4), ((0, -0.002, 0.0120), 0.0316, 0.1000, 4),
             ((0, -0.001, 0.0280), 0.0290, 0.1015, 4.5), ((0, 0, 0.0440), 0.0240, 0.1005, 4.5),
             ((0, 0, 0.0560), 0.0205, 0.1000, 5), ((0, 0, 0.0640), 0.0185, 0.0970, 5)]
    adapter = [(0.0100, -0.0005), (0.0315, -0.0005), (0.0340, 0.0030), (0.0340, 0.0100), (0.0100, 0.0100)]
    plug = box("plug", (-0.0090, -0.0940, -0.0255), (0.0090, -0.0380, 0.0080), 0.003, ngons=True)
    rails = [box(f"rail_{i}", (x - 0.0025, -0.0900, 0.0600), (x + 0.0025, 0.0900, 0.0660), ngons=True)
             for i, x in enumerate((-0.0085, 0.0085))]
    corner = 0.0250 * math.sqrt(0.5)   # of the bolt circle
    bolts = [screw(f"bolt_{i}", "z", (x, y, 0), 0.0030, 0.0025)
             for i, (x, y) in enumerate(((corner, corner), (-corner, corner), (-corner, -corner), (corner, -corner)))]
    return [loft("shell", shell, 40, X, steps=2, first=Z, last=Z), revolve("adapter", adapter, 28, loop=True),
            plug, *rails, *bolts]


def finger():
    """The left finger: a bracket that slims towards the tip, a ribbed pad on the gripping plane y = 0, two screws."""
    side = [(0.0040, 0.0), (0.0264, 0.0), (0.0264, 0.0150), (0.0235, 0.0190), (0.0170, 0.0430), (0.0140, 0.0520),
            (0.0125, 0.0538), (0.0035, 0.0538), (0.0030, 0.0370), (0.0040, 0.0330), (0.0090, 0.0280), (0.0090, 0.0200),
            (0.0040, 0.0170)]
    bracket = prism("bracket", side, -0.0105, 0.0105, chamfer=0.0012)
    teeth = []
    for i in range(4):
        top = 0.0530 - 0.0040 * i
        teeth += [(0.0, top), (0.0, top - 0.0024), (0.0010, top - 0.0030), (0.0010, top - 0.0034)]
    pad = prism("pad", [(0.0050, 0.0534), *teeth, (0.0050, 0.0370)], -0.0088, 0.0088)
    upright = [part.mapped(lambda v: (v[2], v[0], v[1])) for part in (bracket, pad)]
    screws = [screw(f"screw_{i}", "y", (x, 0.0264, 0.0080), 0.0030, 0.0012) for i, x in enumerate((-0.0055, 0.0055))]
    return [*upright, *screws]
