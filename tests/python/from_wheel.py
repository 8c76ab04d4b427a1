"""foam, installed from its wheel: it works, with its own libraries and all of its plugins. Prints the plugins.

from_wheel.py MESH OUT   writes the bytes of the spheres to OUT
"""
import pathlib
import re
import sys

import foam
import foam._plugins

PLACE = pathlib.Path(sys.prefix).resolve()
PACKAGE = pathlib.Path(foam.__file__).resolve().parent
CARRIED = re.compile(r"lib(foam|assimp|fmt|tbb|urdfdom|xxhash|yaml-cpp)[-_.]")


def main(mesh, out):
    assert PACKAGE.is_relative_to(PLACE), PACKAGE
    cover = foam.spherize(mesh, 6)
    assert cover.certified
    pathlib.Path(out).write_bytes(cover.spheres.tobytes())

    foam._plugins.registry()
    loaded = {pathlib.Path(line.split()[-1]) for line in open("/proc/self/maps") if ".so" in line}
    strangers = [path for path in loaded if CARRIED.match(path.name) and not path.is_relative_to(PACKAGE)]
    assert not strangers, strangers
    plugins = sorted((PACKAGE / "lib/foam/plugins").glob("*.so"))
    assert len(plugins) > 10
    assert not set(plugins) - loaded, set(plugins) - loaded
    print(*[plugin.stem for plugin in plugins])


if __name__ == "__main__":
    main(*sys.argv[1:])
