"""Writes a wheel: the zip archive of PEP 427, the same bytes from the same files."""
import base64
import hashlib
import pathlib
import zipfile

EPOCH = (1980, 1, 1, 0, 0, 0) # the earliest of a zip archive


def beside(project, version, more):
    """The description of a wheel that is installed beside that of a project, of the same version."""
    return {**project, "scripts": {}, "optional-dependencies": {}, **more, "dependencies": [f"{project['name']}=={version}"]}


def metadata(project, version):
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {version}", f"Summary: {project['description']}",
             f"License: {project['license']['text']}", f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {needed}" for needed in project["dependencies"]]
    for extra, more in project.get("optional-dependencies", {}).items():
        lines += [f"Provides-Extra: {extra}", *(f'Requires-Dist: {needed}; extra == "{extra}"' for needed in more)]
    return "\n".join(lines) + "\n"


def entry_points(project):
    return "[console_scripts]\n" + "".join(f"{name} = {call}\n" for name, call in sorted(project["scripts"].items()))


def information(project, version, licences, tag):
    """The texts of the folder .dist-info, without its list of files."""
    texts = {
        "METADATA": metadata(project, version),
        "WHEEL": f"Wheel-Version: 1.0\nGenerator: foam\nRoot-Is-Purelib: false\nTag: {tag}\n",
    }
    if project.get("scripts"):
        texts["entry_points.txt"] = entry_points(project)
    return texts | {f"licenses/{name}": file.read_text() for name, file in sorted(licences.items())}


def recorded(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}\n"


def write(out, folder, project, version, licences, tag):
    """Writes the wheel with the files of a folder into the folder `out`; returns its path. `tag`: Python, ABI and platform."""
    stem = f"{project['name'].replace('-', '_')}-{version}"
    paths = {path.relative_to(folder).as_posix(): path for path in sorted(folder.rglob("*"))
             if path.is_file() and "__pycache__" not in path.parts}
    files = {name: path.read_bytes() for name, path in paths.items()}
    files |= {f"{stem}.dist-info/{name}": text.encode() for name, text in information(project, version, licences, tag).items()}
    record = f"{stem}.dist-info/RECORD"
    files[record] = ("".join(recorded(name, data) for name, data in files.items()) + f"{record},,\n").encode()
    out = pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    wheel = out / f"{stem}-{tag}.whl"
    with zipfile.ZipFile(wheel, "w") as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, EPOCH)
            executable = name in paths and paths[name].stat().st_mode & 0o100
            entry.external_attr = (0o100755 if executable else 0o100644) << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED, 9)
    return wheel
