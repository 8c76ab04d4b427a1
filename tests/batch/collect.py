"""Tables: sorted JSON lines, compressed ones, failures alone, arrays as NumPy's format describes them."""
import ast
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import zipfile

from data_set import Foam, expect, write_boxes


def array_of(bytes_):
    """Reads an .npy file as numpy.lib.format describes it, without NumPy."""
    expect(bytes_[:8] == b"\x93NUMPY\x01\x00", "magic")
    length = struct.unpack("<H", bytes_[8:10])[0]
    expect((10 + length) % 64 == 0, "alignment")
    header = ast.literal_eval(bytes_[10:10 + length].decode())
    data = bytes_[10 + length:]
    kind, count = header["descr"], header["shape"][0]
    if kind.startswith("<U"):
        width = 4 * int(kind[2:])
        return [data[i * width:(i + 1) * width].decode("utf-32-le").rstrip("\0") for i in range(count)]
    code = {"<i8": "q", "<f8": "d", "|b1": "?"}[kind]
    flat = struct.unpack(f"<{len(data) // struct.calcsize('<' + code)}{code}", data)
    return [flat[4 * i:4 * i + 4] for i in range(count)] if len(header["shape"]) == 2 else list(flat)


def main():
    with tempfile.TemporaryDirectory() as scratch:
        foam, folder = Foam(sys.argv[1], scratch), pathlib.Path(scratch)
        write_boxes(folder / "boxes", 12)
        shutil.copy(folder / "boxes/box000.obj", folder / "boxes/é copy.obj")
        foam("boxes", "-n", 3, "--run-dir", "out", "--shards", 3, code=4)
        _, err = foam("collect", "out", "-o", "table.jsonl")
        expect("13 meshes, 2 of them failed, 2 with the bytes of another one" in err, err)
        text = (folder / "table.jsonl").read_text()
        lines = [json.loads(line) for line in text.splitlines()]
        expect([line["id"] for line in lines] == sorted(line["id"] for line in lines), "sorted by id")
        expect(all(line["cpu_seconds"] > 0 for line in lines), "times")
        expect(lines[0]["spheres"] == lines[-1]["spheres"], "equal bytes give equal spheres")
        foam("collect", "out", "-o", "failures.jsonl", "--failures")
        failed = [json.loads(line) for line in (folder / "failures.jsonl").read_text().splitlines()]
        expect(failed == [line for line in lines if "error" in line] and len(failed) == 2, failed)
        foam("collect", "out", "-o", "table.jsonl.zst")
        if shutil.which("zstd"):
            plain = subprocess.run(["zstd", "-dc", folder / "table.jsonl.zst"], capture_output=True, text=True)
            expect(plain.stdout == text, "zstd reads it")
        out, _ = foam("collect", "out", "-o", "-")
        expect(out == text, "standard output")

        foam("collect", "out", "-o", "table.npz")
        with zipfile.ZipFile(folder / "table.npz") as archive:
            arrays = {name[:-4]: array_of(archive.read(name)) for name in archive.namelist()}
        expect(arrays["id"] == [line["id"] for line in lines], arrays["id"])
        for i, line in enumerate(lines):
            mine = arrays["spheres"][arrays["start"][i]:arrays["start"][i + 1]]
            expect([list(sphere) for sphere in mine] == line.get("spheres", []), line["id"])
            expect(arrays["certified"][i] == line.get("certified", False), line["id"])

        shard = folder / "out/shard-00001.jsonl.zst"
        whole = shard.read_bytes()
        shard.write_bytes(whole[:-5])
        _, err = foam("collect", "out", "-o", "damaged.jsonl", code=1)
        expect("shard-00001.jsonl.zst: damaged or cut off; remedy: delete it" in err, err)
        expect(not (folder / "damaged.jsonl").exists(), "nothing half-written")
        shard.unlink()
        _, err = foam("collect", "out", "-o", "part.jsonl", code=4)
        expect("have no result yet" in err, err)
        for arguments, message in ((("collect", "out"), "needs -o FILE"), (("status",), "needs the folder"),
                                   (("status", "boxes"), "no results of foam batch in it"), (("boxes", "-n", 3), "--run-dir DIR")):
            process = foam.start(*arguments)
            err = process.communicate()[1]
            expect(process.returncode in (1, 2) and message in err, f"{arguments}: {err}")
        print("tables of 13 meshes")


main()
