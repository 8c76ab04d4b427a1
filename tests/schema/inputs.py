"""Small inputs, and command lines that together print every property: failures, optional parts and figures that are infinite as well."""

ROBOT = """<robot name="arm">
  <link name="base"><collision><geometry><box size="0.4 0.4 0.2"/></geometry></collision></link>
  <link name="upper"><collision><geometry><mesh filename="box.obj"/></geometry></collision></link>
  <link name="hand"><collision><geometry><sphere radius="0.15"/></geometry></collision></link>
  <link name="eye"><visual><geometry><sphere radius="0.01"/></geometry></visual></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.3"/>
    <axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="hand"/><origin xyz="0.3 0 0.1"/>
    <axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="mount" type="fixed"><parent link="hand"/><child link="eye"/></joint>
</robot>
"""
# Six boxes on the faces of the box, a centimetre thick: (position, size).
WALLS = [([x, y, z], [a, b, c]) for x, y, z, a, b, c in (
    (0, 0.05, 0.15, 0.01, 0.11, 0.31), (0.2, 0.05, 0.15, 0.01, 0.11, 0.31), (0.1, 0, 0.15, 0.21, 0.01, 0.31),
    (0.1, 0.1, 0.15, 0.21, 0.01, 0.31), (0.1, 0.05, 0, 0.21, 0.11, 0.01), (0.1, 0.05, 0.3, 0.21, 0.11, 0.01))]
BOX = """v 0 0 0
v 0.2 0 0
v 0 0.1 0
v 0.2 0.1 0
v 0 0 0.3
v 0.2 0 0.3
v 0 0.1 0.3
v 0.2 0.1 0.3
""" + "".join(f"f {face}\n" for face in ("1 3 4", "1 4 2", "5 6 8", "5 8 7", "1 2 6", "1 6 5", "3 7 8", "3 8 4", "1 5 7", "1 7 3", "2 4 8", "2 8 6"))
ARM = """foam: 1
robot: {urdf: [other.urdf, robot.urdf]}
stages: [simplify.quadric: {ratio: 0.5}, spherize.grid, refine.clip]
budget: {spheres: 9}
self_collision: {pose: {elbow: 0.5}}
links:
  base: {clip: [{normal: [0, 0, -1], offset: 0.1, reach: 0.5}]}
outputs: [write.urdf]
variants:
  fine: {budget.spheres: 12, seed: 3}
  without: {links.hand.skip: true}
  budgets: {budget: {spheres: 9, excess: 1, max_protrusion: 0.1, time_limit: 60, share: even}}
  poses: {self_collision: false, budget: {spheres: 9, for: poses}}
"""
FILES = {
    "robot.urdf": ROBOT, "box.obj": BOX, "sheet.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "broken.obj": "v 0 0 0\n",
    "lost.urdf": ROBOT.replace("box.obj", "broken.obj"), "arm.yaml": ARM,
    "fine.yaml": "foam: 1\nextends: arm.yaml\nsnapshots: true\nlinks: {'*': {min_spheres: 2}}\n",
    "lost.yaml": "foam: 1\nextends: arm.yaml\nset: {robot.urdf: lost.urdf}\non_error: skip\nself_collision: false\n",
    "elements.yaml": "foam: 1\nmesh: box.obj\nstages: [approximate.mixed]\nbudget: {elements: 2}\n",
    "cost.yaml": "foam: 1\nmesh: box.obj\nstages: [approximate.mixed]\nbudget: {cost: 9}\n",
    "wrong.yaml": "foam: 1\nmesh: box.obj\nstagse: []\nbudget: {spheres: many}\n",
    "model.csv": "link,x,y,z,radius\nbase,0,0,0,0.3\nupper,0.1,0.05,0.15,0.3\nhand,0,0,0,0.15\n",
    "thin.csv": "link,x,y,z,radius\nbase,0,0,0,0.1\nhand,0,0,0,0.1\nbase,0.25,0,0,0.1\n",
    "mixed.json": """{"foam_spheres": 2, "name": "mixed", "robot": "arm", "guarantee": "fitted", "certified": false, "units": "m", "frame": "link",
        "links": {"hand": {"spheres": [[0, 0, 0, 0.1]], "groups": [], "elements": [
            {"kind": "capsule", "position": [0, 0, 0], "length": 0.1, "radius": 0.1},
            {"kind": "cylinder", "position": [0, 0, 0], "length": 0.1, "radius": 0.1}]}}}""",
    "hollow.json": """{"foam_spheres": 2, "units": "m", "frame": "link", "links": {"box": {"spheres": [], "elements": [""" + ", ".join(
        f'{{"kind": "box", "position": {at}, "size": {size}}}' for at, size in WALLS) + "]}}}",
    "one.csv": "link,x,y,z,radius\nsheet,0,0,0,2\n",
    "theirs.srdf": "<robot name='arm'><disable_collisions link1='base' link2='upper' reason='Adjacent'/>"
                   "<disable_collisions link1='base' link2='hand' reason='Never'/>"
                   "<disable_collisions link1='base' link2='eye' reason='User'/></robot>",
    "refused/bad.so": "no library",
    "set/box.obj": BOX, "set/broken.obj": "v 0 0 0\n",
}
# Exit code and command line.
COMMANDS = [
    (0, "version --json"), (0, "formats --json"), (0, "stages --json"), (0, "describe load.assimp --json"), (0, "schema plan --json"),
    (0, "plugins --plugin-dir refused --json"),
    (0, "check arm.yaml --variant * --json"), (2, "check wrong.yaml --json"),
    (0, "plan fine.yaml --json"), (0, "plan arm.yaml --variant * --json"), (1, "plan lost.yaml --json"),
    (0, "plan elements.yaml --json"), (0, "plan cost.yaml --json"),
    (0, "run arm.yaml --json"), (0, "run arm.yaml --variant without --json"), (4, "run lost.yaml --json"), (0, "cache --clear --json"),
    (0, "verify runs/arm --json"), (0, "run arm.yaml --run-dir changed -q"),
    (0, "spherize box.obj -n 1 -m grid -o changed/arm.urdf --force -q"), (1, "verify changed --json"),
    (0, "spherize box.obj -n 3 -o box.json --json"), (0, "spherize sheet.obj -n 64 --time-limit 0.2 --fresh -o sheet.json --json"),
    (0, "approximate robot.urdf -n 6 --with hull --effort fast -o elements.json --json"),
    (0, "approximate box.obj -n 2 --with sphere,box --effort fast -o boxes.csv --json"),
    (0, "approximate box.obj -n 2 --with swept_box --effort fast -o swept.csv --json"),
    (0, "approximate box.obj -n 2 --with ellipsoid --effort fast -o ellipsoids.json --json"),
    (0, "info robot.urdf --json"), (0, "info sheet.obj --json"),
    (0, "evaluate robot.urdf thin.csv --clip base=0,0,-1,5mm --clip upper=0,0,-1,0 --json"),
    (0, "evaluate robot.urdf model.csv --poses 200 --json"), (0, "evaluate robot.urdf mixed.json --json"), (0, "evaluate sheet.obj one.csv --json"),
    (0, "compare robot.urdf model.csv thin.csv elements.json --json"),
    (0, "certify robot.urdf model.csv --link hand --json"), (1, "certify robot.urdf thin.csv --json"),
    (1, "certify box.obj hollow.json --json"),
    (1, "certify robot.urdf model.csv --guarantee inner --json"),
    (0, "self-collision robot.urdf --samples 200 --spheres 2 --proof-boxes 50 --against theirs.srdf --json"),
    (0, "self-collision robot.urdf --model elements.json --samples 0 --pose elbow=1 --json"),
    (0, "self-collision robot.urdf --model model.csv --samples 1 --proof-boxes 0 --json"),
    (0, "self-collision robot.urdf --samples 1 --spheres 3 --proof-boxes 0 --json"),
    (4, "batch set -n 2 -m grid -j 1 --run-dir out"), (0, "batch status out --json"),
]


def write(folder):
    for name, text in FILES.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)
