"""Makes the wheels of foam from a build folder: foam-spheres for every Python, and beside it the plugins under the GPL, the names of
CoMMALab/foam, and pictures.

foam_wheel.py BUILD OUT   prints the wheels that it wrote into the folder OUT

BUILD is configured with FOAM_WHEEL, which ./foam wheel does. The libraries of others that foam needs are carried along; those that every
Linux has, and those that pictures need, are not. The tag is what auditwheel finds. Needs cmake, ldd, and the packages of
requirements.txt; no network.
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import tomllib

import carried
import wheel_file

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
GPL = pathlib.Path("/usr/share/common-licenses/GPL-3")  # of Debian's base-files
#: The libraries that are linked into foam's, and the Debian packages with their licences.
WITHIN = ("libexpat1-dev", "libarchive-dev", "libzip-dev", "libcpp-httplib-dev")
#: The modules of the wheel foam-spheres-commalab.
OF_COMMALAB = ("_scripts.py", "external.py", "model.py", "utility.py")


class Build:
    """A build folder of foam."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        try:
            lines = (self.folder / "CMakeCache.txt").read_text().splitlines()
        except OSError as error:
            raise SystemExit(f"foam: error: {self.folder} is not a build folder ({error}); remedy: ./foam wheel builds it")
        self.cache = dict(line.partition("=")[::2] for line in lines if "=" in line and not line.startswith(("#", "//")))
        if self.value("FOAM_WHEEL") != "ON":
            raise SystemExit(f"foam: error: {self.folder} was not built for wheels; remedy: ./foam wheel")

    def value(self, name):
        return next((value for key, value in self.cache.items() if key.partition(":")[0] == name), "")

    def install(self, prefix, component):
        subprocess.run([self.value("CMAKE_COMMAND"), "--install", self.folder, "--prefix", prefix, "--strip", "--component", component],
                       check=True, stdout=subprocess.DEVNULL)
        return prefix / self.value("CMAKE_INSTALL_LIBDIR")


class Installed:
    """What a build folder installs, as wheels need it."""

    def __init__(self, build, room):
        self.libraries = build.install(room / "all", "runtime")
        build.install(room / "all", "python")
        self.package = room / "all/lib/python3/dist-packages/foam"
        for module in self.package.glob("_core*.so"):
            module.unlink()  # for Debian's Python alone
        build.install(room / "all", "wheel")  # over some of the others
        self.modules = sorted(self.package.glob("_core*.so"))
        if not self.modules:
            raise SystemExit("foam: error: there is no module for any Python; remedy: install the headers of Python 3.10 to 3.14, "
                             "python3-dev for one")
        self.program = room / "all/bin/foam"
        gpl = build.install(room / "gpl", "gpl") / "foam/plugins"
        # Beside the others they find foam's libraries.
        self.gpl = [pathlib.Path(shutil.move(plugin, self.libraries / "foam/plugins")) for plugin in sorted(gpl.glob("*.so"))]
        self.plugins = sorted(path for path in (self.libraries / "foam/plugins").glob("*.so") if path not in self.gpl)
        late = sorted((self.libraries / "foam/plugins").glob("*/*.so"))
        self.painters = [path for path in late if path.parent.name == "snapshot_osmesa"]
        self.late = [path for path in late if path not in self.painters]


def place(source, folder):
    folder.mkdir(parents=True, exist_ok=True)
    return pathlib.Path(shutil.copy(source, folder))


def place_carried(libraries, names, folder):
    for name, path in libraries.items():
        library = place(path, folder / "foam/lib").rename(folder / "foam/lib" / names[name])
        carried.patch(library, "$ORIGIN", names, soname=names[name])


def lay_out(installed, room):
    """Fills folders of the room with what the wheels hold: main, gpl, commalab, pictures. Returns the libraries of others in the
    first two."""
    main, gpl, own = {}, {}, {}
    for root in [*installed.modules, installed.program, *installed.plugins, *installed.late, *installed.gpl]:
        for name, path in carried.libraries_of(root).items():
            kept = own if path.is_relative_to(installed.libraries) else gpl if root in installed.gpl else main
            kept[name] = path
    gpl = {name: path for name, path in gpl.items() if name not in main}
    names = carried.unique_names(main | gpl)
    package = room / "main/foam"
    shutil.copytree(installed.package, package, ignore=shutil.ignore_patterns("__pycache__", *OF_COMMALAB))
    shutil.copytree(installed.program.parent.parent / "share/foam", package / "share/foam")
    for name in OF_COMMALAB:
        place(installed.package / name, room / "commalab/foam")

    place_carried(main, names, room / "main")
    place_carried(gpl, names, room / "gpl")
    for name, path in own.items():
        carried.patch(place(path, package / "lib").rename(package / "lib" / name), "$ORIGIN", names)
    for wheel, plugins in (("main", installed.plugins), ("gpl", installed.gpl)):
        for plugin in plugins:
            carried.patch(place(plugin, room / wheel / "foam/lib/foam/plugins"), "$ORIGIN/../..", names)
    for wheel, libraries in (("main", installed.late), ("pictures", installed.painters)):
        for path in libraries:
            folder = room / wheel / "foam/lib/foam/plugins" / path.parent.name
            carried.patch(place(path, folder), "$ORIGIN/../../..", names)
    carried.patch(place(installed.program, package / "bin"), "$ORIGIN/../lib", names)
    for module in installed.modules:
        carried.patch(package / module.name, "$ORIGIN/lib", names)
    return [*main.values()], [*gpl.values()]


def main_project(project):
    """The description of the first wheel: without the scripts of another."""
    others = project["tool"]["foam"]["wheels"]["commalab"]["scripts"]
    about = project["project"]
    return {**about, "scripts": {name: call for name, call in about["scripts"].items() if name not in others}}


def platform_of(wheel):
    """The platform tag that auditwheel gives a wheel: the oldest Linux that it runs on."""
    said = carried.run(sys.executable, "-m", "auditwheel", "show", "--json", wheel)
    return json.loads(said)["overall_tag"]


def make_wheels(folder, out):
    """Writes the wheels of a build folder; returns their paths."""
    build = Build(folder)
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    first = main_project(project)
    version = build.value("CMAKE_PROJECT_VERSION")
    apache = {"LICENSE": ROOT / "LICENSE"}
    with tempfile.TemporaryDirectory() as name:
        room = pathlib.Path(name)
        main, gpl = lay_out(Installed(build, room), room)
        licences = {
            "main": apache | carried.licences(main) | carried.licences_of_packages(WITHIN),
            "gpl": {"GPL-3": GPL} | carried.licences(gpl),
            "commalab": apache,
            "pictures": apache,
        }
        trial = wheel_file.write(room, room / "main", first, version, licences["main"], "py3-none-linux_x86_64")
        tags = {"main": f"py3-none-{platform_of(trial)}", "commalab": "py3-none-any", "pictures": "py3-none-linux_x86_64"}
        tags["gpl"] = tags["main"]  # its libraries come from the same build, and it needs those of the first
        wheels = []
        for wheel, more in {"main": {}, **project["tool"]["foam"]["wheels"]}.items():
            if not (room / wheel).is_dir():
                continue  # built without it
            about = wheel_file.beside(first, version, more) if more else first
            wheels.append(wheel_file.write(out, room / wheel, about, version, licences[wheel], tags[wheel]))
    return wheels


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit("usage: foam_wheel.py BUILD OUT")
    print(*make_wheels(sys.argv[1], sys.argv[2]), sep="\n")
