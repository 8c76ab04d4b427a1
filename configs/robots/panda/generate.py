#!/usr/bin/env python3
"""Writes the meshes of the embedded Panda. Python 3, standard library only; the same bytes on every machine.

    generate.py [FOLDER]      default: meshes/ beside this file
"""
import pathlib
import sys

import formats
import links

# file -> (parts, nodes of a COLLADA scene)
MESHES = {
    "link0.stl": (links.link0, None),
    "link1.stl": (links.link1, None),
    "link2.obj": (links.link2, None),
    "link3.dae": (links.link3, links.link3_nodes),
    "link3.obj": (links.link3, links.link3_nodes),
    "link4.stl": (links.link4, None),
    "link5.obj": (links.link5, None),
    "link6.dae": (links.link6, links.link6_nodes),
    "link6.obj": (links.link6, links.link6_nodes),
    "link7.stl": (links.link7, None),
    "hand.obj": (links.hand, None),
    "finger.stl": (links.finger, None),
}


def encode(name):
    parts, nodes = MESHES[name]
    title = f"foam's own model of the Franka Panda: {name.split('.')[0]}"
    kind = name.rsplit(".", 1)[1]
    if kind == "dae":
        return formats.dae(parts(), nodes(), title)
    bodies = formats.placed(parts(), nodes()) if nodes else parts()
    return {"stl": formats.stl, "obj": formats.obj}[kind](bodies, title)


def main():
    here = pathlib.Path(__file__).resolve().parent
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here / "meshes"
    folder.mkdir(parents=True, exist_ok=True)
    for name in MESHES:
        (folder / name).write_bytes(encode(name))


if __name__ == "__main__":
    main()
