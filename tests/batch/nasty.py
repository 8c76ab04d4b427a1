"""Ids, paths, links and archives by which an attacker, or an accident, would stop a batch or mislead a reader."""
import io
import json
import os
import pathlib
import sys
import tarfile
import tempfile
import zipfile

from data_set import Foam, box_text, expect

BOX = box_text(1, 0.5, 0.25)


def write_list(file, items):
    file.write_text("".join(json.dumps(item) + "\n" for item in items))


def ids_of_any_text(foam, folder):
    ids = ["../../up", "/etc/passwd", "a\nb", "c\u2028d", "tab\t", "<script>alert(1)</script>", "e", "ünïcode", "\u202eevil",
           "'; rm -rf /", "x" * 4000, "status", "-"]
    (folder / "box.obj").write_text(BOX)
    write_list(folder / "ids.jsonl", [{"id": name, "path": "box.obj"} for name in ids] +
               [{"id": f"no {name}", "path": "gone.obj"} for name in ids])
    foam("ids.jsonl", "-n", 2, "--run-dir", "ids", code=4)
    results = foam.results("ids")
    expect(set(results) == {*ids, *(f"no {name}" for name in ids)}, "every id has its line")
    expect(all("spheres" in results[name] and "error" in results[f"no {name}"] for name in ids), "spheres and errors")
    page = (folder / "ids/index.html").read_text()
    expect("<script>alert(1)" not in page and "&lt;script&gt;" in page, "the page is escaped")
    out, _ = foam("status", "ids")
    expect("      13  input: …: there is no such file\n" in out, out)


def paths_of_any_kind(foam, folder):
    os.mkfifo(folder / "pipe.obj")
    (folder / "folder.obj").mkdir()
    (folder / "empty.obj").write_bytes(b"")
    (folder / "broken.zip").write_bytes(b"PK\3\4 no archive")
    (folder / "broken.tar").write_bytes(b"no archive" * 100)
    os.symlink("loop.obj", folder / "loop.obj")
    with zipfile.ZipFile(folder / "flipped.zip", "w", zipfile.ZIP_STORED) as archive:
        archive.writestr("a.obj", BOX)
    flipped = bytearray((folder / "flipped.zip").read_bytes())
    flipped[flipped.index(b"v ") + 2] ^= 1  # a stored byte: its checksum is no longer right
    (folder / "flipped.zip").write_bytes(flipped)
    paths = ["flipped.zip::a.obj", "pipe.obj", "folder.obj", "empty.obj", "loop.obj", "broken.zip::a.obj", "broken.tar::a.obj", "/dev/zero",
             "/proc/self/mem", "x" * 300 + ".obj", "box.obj/more.obj", "good.zip::..", "good.zip::../../up.obj", "good.zip::",
             "good.zip::deep.zip::box.obj"]
    with zipfile.ZipFile(folder / "good.zip", "w") as archive:
        archive.writestr("box.obj", BOX)
    write_list(folder / "paths.jsonl", [{"id": "good", "path": "good.zip::box.obj"}] + [{"path": path} for path in paths])
    foam("paths.jsonl", "-n", 2, "--run-dir", "paths", code=4)
    results = foam.results("paths")
    expect(results.pop("good")["certified"], "the good one")
    expect(set(results) == set(paths), results)
    for name, line in results.items():
        expect(line["error"]["code"] == "input", line)


def names_that_leave_an_archive(foam, folder):
    """Members are read, and nothing is written outside of foam's own scratch folder."""
    names = ["../escape.obj", "/absolute.obj", "a/../../b.obj", "back\\slash.obj", "dots/...obj"]
    with zipfile.ZipFile(folder / "leave.zip", "w") as archive, tarfile.open(folder / "leave.tar", "w") as tar:
        for name in names:
            archive.writestr(name, BOX)
            entry = tarfile.TarInfo(name)
            entry.size = len(BOX)
            tar.addfile(entry, io.BytesIO(BOX.encode()))
    for source in ("leave.zip", "leave.tar"):
        foam(source, "-n", 2, "--run-dir", source + ".out")
        results = foam.results(source + ".out")
        expect(len(results) == len(names) and all(line["certified"] for line in results.values()), results)
    expect(not (folder / "escape.obj").exists() and not (folder.parent / "escape.obj").exists() and
           not pathlib.Path("/absolute.obj").exists(), "nothing is unpacked beside")


def links_in_a_tar(foam, folder):
    """As tar itself: the last of several files with a name counts, and a hard link has its file's content."""
    with tarfile.open(folder / "links.tar", "w") as archive:
        for name, text in (("a.obj", "f 1 2 3\n"), ("a.obj", BOX)):
            entry = tarfile.TarInfo(name)
            entry.size = len(text)
            archive.addfile(entry, io.BytesIO(text.encode()))
        link = tarfile.TarInfo("b.obj")
        link.type, link.linkname = tarfile.LNKTYPE, "a.obj"
        archive.addfile(link)
    foam("links.tar", "-n", 2, "--run-dir", "links")
    results = foam.results("links")
    expect(set(results) == {"a.obj", "b.obj"} and results["a.obj"]["spheres"] == results["b.obj"]["spheres"], results)


def links_in_a_folder(foam, folder):
    tree = folder / "tree"
    (tree / "real").mkdir(parents=True)
    (tree / "real/box.obj").write_text(BOX)
    (folder / "elsewhere").mkdir()
    (folder / "elsewhere/other.obj").write_text(BOX)
    for target, name in (("../elsewhere", "linked"), ("..", "real/up"), ("real/../..", "round"), ("nowhere", "gone.obj"),
                         ("self.obj", "self.obj"), ("nowhere", "gone")):
        os.symlink(target, tree / name)
    foam("tree", "-n", 2, "--run-dir", "tree.out", code=4)
    results = foam.results("tree.out")
    found = {name for name in results if not name.startswith("round/")}
    expect(found == {"real/box.obj", "linked/other.obj", "gone.obj", "self.obj"}, sorted(results))
    expect(all(("error" in line) == (name.split("/")[-1] in ("gone.obj", "self.obj", "loop.obj", "empty.obj", "pipe.obj"))
               for name, line in results.items()), results)


def reasons_that_show_a_path(foam, folder):
    """A failure has the same text wherever the data set lies, also where messages show its path escaped."""
    lines = []
    for place in ("here", "there/below"):
        (folder / place).mkdir(parents=True)
        (folder / place / "bad\u2028name.obj").write_text("no mesh\n")
        foam(place, "-n", 1, "--run-dir", place + ".out", code=4)
        lines.append(foam.results(place + ".out")["bad\u2028name.obj"]["error"])
    expect(lines[0] == lines[1] and str(folder) not in json.dumps(lines), lines)


def a_stage_that_ends_its_process(folder):
    """Exit code 2 is what a worker says that cannot start."""
    foam = Foam(sys.argv[1], folder, plugin=sys.argv[2])
    (folder / "ill").mkdir()
    (folder / "ill/two.ill").write_text("exit_two\n")
    (folder / "ill/well.ill").write_text("well\n")
    foam("ill", "-n", 1, "--run-dir", "ill.out", code=4)
    results = foam.results("ill.out")
    expect(results["two.ill"]["error"]["code"] == "crash" and results["well.ill"]["certified"], results)


def damaged_folders(foam, folder):
    (folder / "some").mkdir()
    (folder / "some/box.obj").write_text(BOX)
    for text in ("", "{}", '{"format": "foam batch 1"}', '{"format": "foam batch 1", "meshes": "x"}'):
        out = folder / "damaged"
        out.mkdir(exist_ok=True)
        (out / "batch.json").write_text(text)
        _, err = foam("some", "-n", 1, "--run-dir", "damaged", code=1)
        expect("damaged/batch.json: not foam's record of a batch; remedy: another folder" in err, err)
    (folder / "file").write_text("")
    for out in ("file", "file/below"):
        process = foam.start("some", "-n", 1, "--run-dir", out)
        err = process.communicate()[1]
        expect(process.returncode not in (0, 4) and "file" in err and "remedy" not in err[:0], err)
    foam("some", "-n", 1, "--run-dir", "twice", "--shard", 0, "--shard", 0)
    out, _ = foam("some", "-n", 1, "--run-dir", "twice", "--shard", 0, "--shard", 0)
    expect(out.startswith("1 mesh: 1 with spheres"), out)


def two_recipes_at_once(foam, folder):
    """One of them wins, and the folder is whole; the others are refused."""
    (folder / "many").mkdir()
    for i in range(40):
        (folder / f"many/{i}.obj").write_text(box_text(1 + i, 1, 1))
    write_list(folder / "half.jsonl", [{"path": f"many/{i}.obj"} for i in range(20)])
    for attempt in range(4):
        runs = [foam.start(what, "-n", n, "--run-dir", f"race{attempt}", "-j", 1)
                for what, n in (("many", 1), ("many", 2), ("half.jsonl", 1))]
        texts = [run.communicate()[1] for run in runs]
        codes = sorted(run.returncode for run in runs)
        expect(codes == [0, 2, 2], f"{codes} {texts}")
        out, _ = foam("status", f"race{attempt}", "--json")
        status = json.loads(out)
        expect(status["done"] == status["meshes"] in (20, 40) and status["failed"] == 0, out)


def main():
    for attack in (ids_of_any_text, paths_of_any_kind, names_that_leave_an_archive, links_in_a_tar, links_in_a_folder,
                   damaged_folders, two_recipes_at_once, reasons_that_show_a_path):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch, "work")
            folder.mkdir()
            if attack in (paths_of_any_kind, links_in_a_folder):
                (folder / "box.obj").write_text(BOX)
            attack(Foam(sys.argv[1], folder), folder)
    with tempfile.TemporaryDirectory() as scratch:
        a_stage_that_ends_its_process(pathlib.Path(scratch))
    print("ids, paths, archives, links, folders: every mesh has its line")


main()
