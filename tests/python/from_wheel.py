"""foam, installed from its wheel: it works, with its own libraries and all of its plugins. Prints the plugins.

from_wheel.py MESH OUT [RECIPE]   writes the bytes of the mesh's spheres to OUT; runs the recipe, without pictures
"""
import pathlib
import re
import sys

import foam

PLACE = pathlib.Path(sys.prefix).resolve()
PACKAGE = pathlib.Path(foam.__file__).resolve().parent
CARRIED = re.compile(r"lib(foam|archive|assimp|fmt|tbb|urdfdom|xxhash|yaml-cpp)[-_.]")


def run_recipes(mesh, recipe):
    # Pictures take libraries of the system.
    without_pictures = {"snapshots": False, "debug.snapshots": False, "stages.spherize.cover.effort": "fast"}
    run = foam.run(recipe, set=without_pictures, out="run", cache="cache")
    assert run.certified and len(run.model) == 11, run.model
    assert sum(map(len, run.model.values())) == 22
    assert [file for file in run.outputs if file.name == "panda_22.urdf" and file.is_file()], run.outputs

    # A stage in a child process: of the program that came along.
    isolated = {"foam": 1, "name": "part", "mesh": [mesh], "stages": [{"spherize.cover": {}}], "budget": {"spheres": 4},
                "isolate": "process", "outputs": [{"write.csv": {"file": "part.csv"}}]}
    assert foam.run(isolated, fresh=True).certified


def main(mesh, out, recipe=None):
    assert PACKAGE.is_relative_to(PLACE), PACKAGE
    cover = foam.spherize(mesh, 6)
    assert cover.certified
    pathlib.Path(out).write_bytes(cover.spheres.tobytes())
    assert foam.plugins()
    if recipe:
        run_recipes(mesh, recipe)

    loaded = {pathlib.Path(line.split()[-1]) for line in open("/proc/self/maps") if ".so" in line}
    strangers = [path for path in loaded if CARRIED.match(path.name) and not path.is_relative_to(PACKAGE)]
    assert not strangers, strangers
    plugins = sorted((PACKAGE / "lib/foam/plugins").glob("*.so"))
    assert len(plugins) > 10
    assert not set(plugins) - loaded, set(plugins) - loaded
    print(*[plugin.stem for plugin in plugins])


if __name__ == "__main__":
    main(*sys.argv[1:])
