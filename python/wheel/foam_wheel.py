"""Makes the wheels foam-spheres and foam-spheres-gpl from a build folder. The second holds the plugins under the GPL.

foam_wheel.py BUILD OUT   prints the wheels that it wrote into the folder OUT

It is also the backend for `pip wheel python/`, which makes the first. The libraries of others that foam needs are carried along; those
that every Linux has, and those that pictures need, are not. Needs cmake, ldd and patchelf, no network.
"""
import pathlib
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import tomllib

import carried
import wheel_file

PYTHON = pathlib.Path(__file__).resolve().parent.parent
ROOT = PYTHON.parent
GPL = pathlib.Path("/usr/share/common-licenses/GPL-3")  # of Debian's base-files


class Build:
    """A build folder of foam."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        try:
            lines = (self.folder / "CMakeCache.txt").read_text().splitlines()
        except OSError as error:
            raise SystemExit(f"foam: error: {self.folder} is not a build folder ({error}); remedy: ./foam wheel builds it")
        self.cache = dict(line.partition("=")[::2] for line in lines if "=" in line and not line.startswith(("#", "//")))

    def value(self, name):
        return next(value for key, value in self.cache.items() if key.partition(":")[0] == name)

    def install(self, prefix, component):
        subprocess.run([self.value("CMAKE_COMMAND"), "--install", self.folder, "--prefix", prefix, "--strip", "--component", component],
                       check=True, stdout=subprocess.DEVNULL)
        return prefix / self.value("CMAKE_INSTALL_LIBDIR")


def gather(build, room):
    """Installs foam; returns its package, the module in it, the folder of its libraries, its program, and its plugins under the GPL,
    if it has some."""
    libraries = build.install(room / "all", "runtime")
    build.install(room / "all", "python")
    package = room / "all/lib/python3/dist-packages/foam"
    core = package / f"_core{sysconfig.get_config_var('EXT_SUFFIX')}"
    if not core.is_file():
        raise SystemExit(f"foam: error: {build.folder} has no package for Python {sys.version.split()[0]}; remedy: build it with "
                         f"-DPython_EXECUTABLE={sys.executable} and the Debian packages python3-dev and pybind11-dev")
    gpl = build.install(room / "gpl", "gpl") / "foam/plugins"
    # Beside the others they find foam's libraries.
    moved = [shutil.move(plugin, libraries / "foam/plugins") for plugin in sorted(gpl.glob("*.so"))]
    return package, core, libraries, room / "all/bin/foam", [pathlib.Path(plugin) for plugin in moved]


def place(source, folder):
    folder.mkdir(parents=True, exist_ok=True)
    return pathlib.Path(shutil.copy(source, folder))


def lay_out(package, core, libraries, program, gpl, room):
    """Fills the folders room/main and room/others with what the wheels hold."""
    plugins = sorted(path for path in (libraries / "foam/plugins").glob("*.so") if path not in gpl)
    # Pictures: the libraries of the painter (OpenCV, OSMesa and 150 that these bring) are those of the system, if it has them.
    late = sorted((libraries / "foam/plugins").glob("*/*.so"))
    painters = [path for path in late if path.parent.name == "snapshot_osmesa"]
    closures = {path: carried.libraries_of(path) for path in [core, program, *plugins, *gpl, *late] if path not in painters}
    own, main, others = {}, {}, {}
    for root, closure in closures.items():
        for name, path in closure.items():
            if path.is_relative_to(libraries):
                own[name] = path
            else:
                (others if root in gpl else main)[name] = path
    others = {name: path for name, path in others.items() if name not in main}

    names = carried.unique_names(main | others)
    for folder, roots, libraries_of_others in ((room / "main", plugins, main), (room / "others", gpl, others)):
        for name, path in libraries_of_others.items():
            library = place(path, folder / "foam/lib").rename(folder / "foam/lib" / names[name])
            carried.patch(library, "$ORIGIN", names, soname=names[name])
        for plugin in roots:
            carried.patch(place(plugin, folder / "foam/lib/foam/plugins"), "$ORIGIN/../..", names)
    for name, path in own.items():
        carried.patch(place(path, room / "main/foam/lib").rename(room / "main/foam/lib" / name), "$ORIGIN", names)
    for path in late:
        carried.patch(place(path, room / "main/foam/lib/foam/plugins" / path.parent.name), "$ORIGIN/../../..", names)
    carried.patch(place(program, room / "main/foam/bin"), "$ORIGIN/../lib", names)
    shutil.copytree(package, room / "main/foam", dirs_exist_ok=True)
    place(PYTHON / "wheel/_program.py", room / "main/foam")
    carried.patch(room / "main/foam" / core.name, "$ORIGIN/lib", names)
    return [*main.values()], [*others.values()]


def make_wheels(folder, out, with_gpl=True):
    """Writes the wheels of a build folder; returns their paths."""
    build = Build(folder)
    project = tomllib.loads((PYTHON / "pyproject.toml").read_text())
    version = build.value("CMAKE_PROJECT_VERSION")
    wheels = []
    with tempfile.TemporaryDirectory() as name:
        room = pathlib.Path(name)
        package, core, libraries, program, gpl = gather(build, room)
        main, others = lay_out(package, core, libraries, program, gpl, room)
        apache = {"LICENSE": ROOT / "LICENSE"}
        wheels.append(wheel_file.write(out, room / "main", project["project"], version, apache | carried.licences(main)))
        if gpl and with_gpl:
            about = {**project["project"], "scripts": {}, "optional-dependencies": {}, **project["tool"]["foam"]["gpl"], "dependencies": [f"foam-spheres=={version}"]}
            wheels.append(wheel_file.write(out, room / "others", about, version, {"GPL-3": GPL} | carried.licences(others)))
    return wheels


def get_requires_for_build_wheel(config_settings=None):
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """PEP 517. `build-dir` among the settings: a build folder; by default that of ./foam, built if necessary."""
    folder = (config_settings or {}).get("build-dir")
    if not folder:
        folder = ROOT / "build/release"
        subprocess.run([ROOT / "foam", "python", "-c", ""], check=True)
    return make_wheels(folder, wheel_directory, with_gpl=False)[0].name


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("foam has no source distribution for Python; remedy: a clone, and ./foam wheel")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit("usage: foam_wheel.py BUILD OUT")
    print(*make_wheels(sys.argv[1], sys.argv[2]), sep="\n")
