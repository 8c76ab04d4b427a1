"""Lists of every format, archives, units and scales; bad lists have a place and a remedy."""
import io
import json
import pathlib
import subprocess
import sys
import tarfile
import tempfile
import zipfile

from data_set import Foam, box_text, expect

BAD = {
    "empty.jsonl": ("", "empty.jsonl: no mesh in it"),
    "words.jsonl": ("{}\nhello\n", "words.jsonl:1: no 'path'"),
    "text.jsonl": ("\n\nhello\n", "text.jsonl:3: not JSON"),
    "list.jsonl": ("[1]\n", "list.jsonl:1: not a JSON object"),
    "scale.jsonl": ('{"path": "a.obj", "scale": -1}\n', "scale.jsonl:1: 'scale' must be a number above 0, not -1"),
    "unit.jsonl": ('{"path": "a.obj", "unit": "mile"}\n', "unit.jsonl:1: "),
    "count.jsonl": ('{"path": "a.obj", "spheres": 1.5}\n', "'spheres' must be an integer of 1 to 1000000, not 1.5"),
    "key.jsonl": ('{"path": "a.obj", "scales": 1}\n', "unknown key 'scales'; did you mean 'scale'?"),
    "twice.jsonl": ('{"path": "a.obj"}\n{"path": "a.obj"}\n', "the id 'a.obj' occurs twice"),
    "table.csv": ("id,path\na\n", "table.csv:2: 1 fields for 2 columns"),
    "quote.csv": ('path\n"a.obj\n', "quote.csv:2: a quotation mark is not closed"),
    "column.csv": ("id,file\na,b\n", "column.csv:1: unknown key 'file'"),
    "kind.xyz": ("a.obj\n", "kind.xyz: not a list of meshes"),
    "key_twice.jsonl": ('{"path": "a.obj", "path": "b.obj"}\n', "key_twice.jsonl:1: the key 'path' stands twice"),
    "column_twice.csv": ("path,path\na,b\n", "column_twice.csv:1: the column 'path' stands twice"),
    "zero.jsonl": ('{"path": "a.obj\\u0000.obj"}\n', "zero.jsonl:1: 'path' must not hold a zero byte"),
    "infinite.csv": ("path,scale\na.obj,inf\n", "infinite.csv:2: "),
    "bytes.csv": (b"path,scale\na.obj,\xff\n", "bytes.csv:2: 'scale' must be a number above 0, not \"\ufffd\""),
    "bytes.txt": (b"\xff.obj\n", "bytes.txt: '\\xff.obj' is not UTF-8"),
}


def write_archives(folder, files):
    with zipfile.ZipFile(folder / "set.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    with tarfile.open(folder / "set.tar", "w") as archive:
        for name, text in files.items():
            entry = tarfile.TarInfo(name)
            entry.size = len(text)
            archive.addfile(entry, io.BytesIO(text.encode()))


def spheres(results):
    return {name: line["spheres"] for name, line in results.items()}


def main():
    with tempfile.TemporaryDirectory() as scratch:
        foam, folder = Foam(sys.argv[1], scratch), pathlib.Path(scratch)
        long_name = "deep/" * 30 + "c.obj"  # a tar needs a second header for it
        files = {"a.obj": box_text(1, 0.5, 0.25), "sub/b.obj": box_text(0.2, 0.2, 0.2), long_name: box_text(1, 1, 2)}
        for name, text in files.items():
            file = folder / "set" / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        (folder / "set" / "notes.md").write_text("no mesh")
        write_archives(folder, {**files, "notes.md": "no mesh"})
        foam("set", "-n", 3, "--run-dir", "folder")
        truth = spheres(foam.results("folder"))
        expect(set(truth) == set(files), truth)
        for source in ("set.zip", "set.tar"):
            foam(source, "-n", 3, "--run-dir", source + ".out")
            expect(spheres(foam.results(source + ".out")) == truth, source)

        (folder / "list.txt").write_text("".join(f"set/{name}\r\n" for name in files))
        foam("list.txt", "-n", 3, "--run-dir", "text")
        expect(list(spheres(foam.results("text")).values()) == [truth[name] for name in sorted(truth)], "text")
        (folder / "list.csv").write_text('id,path,scale,unit,spheres\n"one, two",set/a.obj,,,\nmm,set/a.obj,,mm,\n'
                                         "large,set.zip::a.obj,1000,mm,\nfew,set.tar::a.obj,,,1\n")
        foam("list.csv", "-n", 3, "--run-dir", "table")
        table = foam.results("table")
        expect(table["one, two"]["spheres"] == table["large"]["spheres"] == truth["a.obj"], "scales")
        expect(len(table["few"]["spheres"]) == 1 and table["mm"]["size_m"] == [1e-3, 5e-4, 2.5e-4], table)
        (folder / "spreadsheet.csv").write_text("\ufeffpath\nset/a.obj\n", encoding="utf-8")
        foam("spreadsheet.csv", "-n", 3, "--run-dir", "marked")
        expect(spheres(foam.results("marked")) == {"set/a.obj": truth["a.obj"]}, "a byte order mark")
        foam("set/*.obj", "-n", 3, "--run-dir", "glob")
        expect(spheres(foam.results("glob")) == {"set/a.obj": truth["a.obj"]}, "glob")

        lines = "".join(json.dumps({"id": i, "path": f"set/{name}"}) + "\n" for i, name in enumerate(files))
        piped = subprocess.run([*foam.command, "-", "-n", "3", "--run-dir", "piped"], cwd=scratch, input=lines, text=True,
                               capture_output=True)
        expect(piped.returncode == 0 and set(foam.results("piped")) == {"0", "1", "2"}, piped.stderr)
        for name, (text, message) in BAD.items():
            (folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
            _, err = foam(name, "-n", 3, "--run-dir", "bad", code=1)
            expect(message in err, f"{name}: {err}")
        expect(not (folder / "bad").exists(), "a bad list leaves no folder")
        missing = {"gone": "set/gone.obj", "member": "set.zip::gone.obj", "tar": "set.tar::gone.obj", "zip": "no.zip::a.obj"}
        (folder / "missing.jsonl").write_text("".join(json.dumps({"id": i, "path": p}) + "\n" for i, p in missing.items()))
        foam("missing.jsonl", "-n", 3, "--run-dir", "missing", code=4)
        for name, line in foam.results("missing").items():
            expect(line["error"]["code"] == "input" and "there is no such" in line["error"]["reason"] or
                   "no file 'gone.obj' in the archive" in line["error"]["reason"], line)
        print("lists, archives, units and scales: the same spheres; bad lists have a place")


main()
