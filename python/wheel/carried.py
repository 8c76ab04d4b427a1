"""The shared libraries that a wheel carries along: which, under which names, with which licences."""
import hashlib
import pathlib
import re
import shutil
import subprocess
import sys

# What every Linux with this glibc has: PEP 600's list, as far as foam needs it.
OF_THE_SYSTEM = re.compile(r"(ld-linux.*|lib(c|m|dl|pthread|rt|gcc_s|stdc\+\+))\.so\b.*")


def run(*command):
    try:
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout
    except FileNotFoundError:
        raise SystemExit(f"foam: error: there is no {command[0]}; remedy: ./foam wheel installs it") from None


def libraries_of(path):
    """Name and path of every library that a library needs, directly or not, without those of the system."""
    found = {}
    for name, target in re.findall(r"^\s*(\S+) => (not found|\S+)", run("ldd", path), re.M):
        if OF_THE_SYSTEM.fullmatch(name):
            continue
        if target == "not found":
            raise SystemExit(f"foam: error: {path.name} needs {name}, which is missing; remedy: install its package")
        found[name] = pathlib.Path(target).resolve()
    return found


def unique_names(libraries):
    """A name for each library of others, with a digest: a library of another package may bear the same name."""
    names = {}
    for name, path in libraries.items():
        stem, _, version = name.partition(".so")
        names[name] = f"{stem}-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}.so{version}"
    return names


def patch(library, run_path, names, soname=None):
    """Makes a library look for others in the run path, under their new names."""
    needed = run("patchelf", "--print-needed", library).split()
    changes = [part for name in needed if name in names for part in ("--replace-needed", name, names[name])]
    changes += ["--set-soname", soname] if soname else []
    run("patchelf", *changes, "--set-rpath", run_path, library)


def packages_of(paths):
    """The Debian package of each file, by its path; none for files of no package. /lib is /usr/lib, and packages may name either."""
    paths_by_name = {name: path for path in paths for name in (str(path), str(path).removeprefix("/usr"))}
    if not paths_by_name or not shutil.which("dpkg"):
        return {}
    # One call for all: each reads the lists of every package.
    listed = subprocess.run(["dpkg", "-S", *paths_by_name], capture_output=True, text=True).stdout
    packages = {}
    for line in listed.splitlines():
        package, _, name = line.rpartition(": ")
        if name in paths_by_name:
            packages.setdefault(paths_by_name[name], package.partition(":")[0])
    return packages


def licence_of(package):
    """The file with the licence of a Debian package."""
    return pathlib.Path("/usr/share/doc", package, "copyright")


def licences_of_packages(packages):
    """The same for packages by their names."""
    return {f"{package}.txt": licence_of(package) for package in packages}


def licences(libraries):
    """The file with the licence of each Debian package with one of the libraries, by the name it is to have."""
    texts = {}
    packages = packages_of(libraries)
    for path in libraries:
        package = packages.get(path)
        text = licence_of(package or "")
        if package and text.is_file():
            texts[f"{package}.txt"] = text
        else:
            print(f"foam: warning: {path} comes without its licence text; remedy: add it before you publish the wheel", file=sys.stderr)
    return texts
