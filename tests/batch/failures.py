"""Meshes that crash, hang or eat memory are failures with a name, and the others have their spheres."""
import json
import os
import pathlib
import sys
import tempfile

from data_set import Foam, expect

WISHES = {"well": None, "again": None, "segv": "crash", "abort": "crash", "exit": "crash", "loop": "time limit",
          "eat": "geometry", "error": "geometry", "exception": "plugin", "overflow": "crash"}


def main():
    with tempfile.TemporaryDirectory() as scratch:
        foam = Foam(sys.argv[1], scratch, plugin=sys.argv[2])
        folder = pathlib.Path(scratch, "set")
        folder.mkdir()
        for wish in WISHES:
            (folder / f"{wish}.ill").write_text(wish + "\n")
        limits = ("--time-limit", 6, "--memory-limit", 300)
        if "sanitizer" in foam.start("set", "-n", 1, "--run-dir", "none", *limits).communicate()[1]:
            limits = ("--time-limit", 30)  # it takes longer, and cannot enforce a limit of memory
            for name in ("ASAN_OPTIONS", "TSAN_OPTIONS"):  # else it reports a crash itself, in more time than the limit leaves
                os.environ[name] = f"{os.environ.get(name, '')}:handle_segv=0:handle_abort=0"
            (folder / "eat.ill").unlink()
            del WISHES["eat"]
        for _ in range(2):  # the second time from what was written
            foam("set", "-n", 1, "--run-dir", "out", *limits, "-j", 2, code=4)
        results = foam.results("out")
        expect(set(results) == {f"{wish}.ill" for wish in WISHES}, sorted(results))
        for wish, code in WISHES.items():
            line = results[f"{wish}.ill"]
            if code is None:
                expect(line["certified"] and len(line["spheres"]) == 1, line)
            else:
                print(wish, line["error"])
                expect(code == line["error"]["code"], f"{wish}: {line}")
        if "eat" in WISHES:
            expect(results["eat.ill"]["error"]["reason"].endswith("not enough memory"), results["eat.ill"])
        expect("SIGSEGV" in results["segv.ill"]["error"]["reason"] and
               "load.ill" in results["segv.ill"]["error"]["reason"], results["segv.ill"])
        out, _ = foam("status", "out", "--json")
        status = json.loads(out)
        expect((status["meshes"], status["done"], status["failed"]) == (len(WISHES), len(WISHES), len(WISHES) - 2), out)
        expect(sum(status["failures"].values()) == len(WISHES) - 2, out)
        page = pathlib.Path(scratch, "out", "index.html").read_text()
        expect(page.count("<tr><th scope") == len(WISHES) and page.count("<circle") == 2, "the page shows all")


main()
