#!/usr/bin/env python3
"""Mutation testing of the proof: changes the code of certificate, growth, measures and round trip in one place at a time and
runs the tests that belong to it. A change that no test notices survives. See docs/dev/testing.md."""
import argparse
import concurrent.futures
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from mutations import mutants_of  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
BUILD = Path(os.environ.get("FOAM_MUTATION_BUILD", ROOT / "build" / "mutation"))
CORE, TESTS = ROOT / "core", ROOT / "tests"

SURFACE = ["geometry/balls_test", "geometry/crease_cuts_test", "geometry/certificate_test", "evaluate/certificate_adversary_test"]
GROWN = ["geometry/growth_steps_test", "geometry/growth_test"]
MEASURED = ["geometry/volume_test", "geometry/measure_test"]
INNER = ["geometry/rim_test", "geometry/inner_test"]
ELEMENTS = ["evaluate/element_adversary_test", "evaluate/two_elements_adversary_test", "evaluate/element_shells_test",
            "evaluate/element_growth_ends_test", "geometry/element_certificate_test"]

SOLIDS = ["geometry/solid_proof_test"]
NERVES = ["geometry/common_point_test", "geometry/nerve_test"]
ENLARGED = ["geometry/element_enlarged_test", "geometry/grown_to_points_test", "geometry/element_test", "geometry/element_growth_test"]

MATRIX = [f"self_collision/matrix{part}_test" for part in ("", "_samples", "_geometry")]

# Which tests belong to which file, the ones that are likely to notice first. `core` names the files of core that tests link besides.
BELONG = {
    "geometry/src/proof/certificate.cpp": SURFACE + GROWN,
    "geometry/src/proof/cover.cpp": SURFACE + GROWN,
    "geometry/src/proof/crease_cuts.cpp": SURFACE + GROWN,
    "geometry/src/proof/growth.cpp": GROWN + SURFACE,
    "geometry/src/proof/shrinking.cpp": GROWN,
    "geometry/src/proof/inner.cpp": INNER,
    "geometry/src/proof/rim.cpp": INNER,
    "geometry/src/measure/measure.cpp": MEASURED,
    "geometry/src/measure/measure_surface.cpp": MEASURED,
    "geometry/src/measure/measure_volume.cpp": MEASURED,
    "geometry/src/measure/exact_union_volume.cpp": MEASURED,
    "geometry/src/solid/intervals.cpp": ["geometry/intervals_test"],
    "geometry/src/proof/element_proof.cpp": ["geometry/element_proof_test", "geometry/element_gap_test"] + ELEMENTS,
    "geometry/src/proof/bodies.cpp": ["geometry/bodies_test", "geometry/bodies_of_nothing_test", "geometry/near_bodies_test"] + ELEMENTS,
    "geometry/src/proof/cavities.cpp": SOLIDS,
    "geometry/src/proof/nerve.cpp": NERVES + SOLIDS,
    "geometry/src/proof/common_point.cpp": NERVES + SOLIDS,
    "geometry/src/proof/surface_pieces.cpp": SOLIDS,
    "geometry/src/proof/walls.cpp": SOLIDS,
    "geometry/src/proof/ball_tops.cpp": SOLIDS,
    "geometry/src/proof/deepest.cpp": SOLIDS,
    "geometry/src/proof/filling.cpp": SOLIDS + GROWN,
    "geometry/src/proof/body_cuts.cpp": ["geometry/body_cuts_test", "geometry/triangles_across_test"] + ELEMENTS,
    "geometry/src/proof/element_growth.cpp": ["geometry/element_growth_test"] + ELEMENTS,
    "geometry/src/convex/polytope.cpp": ["geometry/faces_moved_test", "geometry/grown_to_points_test", "geometry/element_grown_test", "geometry/element_test"] + ELEMENTS,
    "geometry/src/convex/hull.cpp": ENLARGED + ELEMENTS,
    "geometry/src/convex/swept_box.cpp": ENLARGED + ELEMENTS,
    "geometry/src/convex/cylinder.cpp": ENLARGED + ELEMENTS,
    "geometry/src/convex/ellipsoid.cpp": ["geometry/ellipsoid_test"] + ENLARGED + ELEMENTS,
    "geometry/src/mesh/surface_runs.cpp": ["geometry/surface_runs_test", "geometry/balls_test"],
    "geometry/src/mesh/needle_index.cpp": ["geometry/needle_index_test", "geometry/needle_solid_test"],
    "geometry/src/hull/convex_hull.cpp": ["geometry/convex_hull_test", "geometry/hull_planes_test", "geometry/element_test"],
    "geometry/src/hull/quickhull.cpp": ["geometry/quickhull_test", "geometry/convex_hull_test"],
    "geometry/src/hull/farthest.cpp": ["geometry/convex_hull_test"],
    "robot/src/chain.cpp": ["kinematics/chain_test", "self_collision/touching_proof_test", "self_collision/proof_test", *MATRIX],
    "robot/src/proved_links.cpp": ["evaluate/statement_test"],
    "collision/src/proof.cpp": ["self_collision/touching_proof_test", "self_collision/proof_test", *MATRIX],
    "collision/src/separation.cpp": ["self_collision/separation_test", "self_collision/touching_proof_test", "self_collision/proof_test"],
    "collision/src/simplex.cpp": ["self_collision/simplex_test", "self_collision/separation_test"],
    "collision/src/link_shapes.cpp": ["self_collision/touching_links_test", *MATRIX],
    "collision/src/matrix.cpp": MATRIX,
    "search/src/convex/orientation_bounds.cpp": ["convex/orientation_bounds_test", "convex/least_element_test"],
    "search/src/convex/proved_least.cpp": ["convex/proved_least_test", "convex/least_element_test"],
    "judge/src/evaluate/evaluate.cpp": ["evaluate/judged_links_test"],
    "judge/src/evaluate/match.cpp": ["evaluate/judged_links_test"],
    "judge/src/evaluate/proved_links.cpp": ["evaluate/judged_links_test"],
    "judge/src/written_model.cpp": ["evaluate/written_model_test"],
    "runtime/src/finish/written_numbers.cpp": ["run/growth_by_steps_test", "run/written_numbers_test"],
    "runtime/src/finish/cover.cpp": ["run/finished_tree_test"],
    "runtime/src/finish/written_proof.cpp": ["run/written_proof_test"],
    "base/src/number_text.cpp": ["data/text_test", "run/finished_tree_test"],
}
WHOLE = {"base", "geometry", "xml", "robot", "sdk", "collision"}  # libraries that tests link
# And these files of others, or those whose paths begin so.
LINKED = ("runtime/src/contract/sample.cpp", "runtime/src/finish/cover.cpp", "runtime/src/finish/written_", "judge/src/evaluate/",
          "judge/src/written_model.cpp", "search/src/convex/", "search/src/by_spheres/")
FLAGS = ("-std=c++20 -O1 -fPIC -DNDEBUG -D_GLIBCXX_ASSERTIONS -ffp-contract=off -w -DFMT_SHARED -DFOAM_VERSION=\"mutation\" "
         "-DFOAM_YAML_CPP_VERSION=\"\" -DFOAM_PLUGIN_SUBDIRECTORY=\"foam/plugins\" -isystem /usr/include/eigen3").split()
LIBRARIES_OF_CORE = ["base", "geometry", "xml", "robot", "collision", "search", "sdk", "yaml", "recipe", "report", "runtime", "judge"]
INCLUDES = [f"-I{BUILD}/include", f"-I{CORE}", f"-I{TESTS}"] + [f"-I{CORE}/{name}/{part}" for name in LIBRARIES_OF_CORE for part in ("include", "src")]
LIBRARIES = "-lgmock -lgtest -lgtest_main -ltbb -lfmt -lyaml-cpp -lexpat -lxxhash -lpthread -ldl".split()
HEADERS = {"core": "algorithm array cmath cstdint filesystem functional map memory optional set span string string_view variant vector "
                   "fmt/format.h".split(),
           "tests": "gmock/gmock.h gtest/gtest.h algorithm filesystem fstream string vector".split()}


def compiler():
    return os.environ.get("CXX", "g++")


def run(command, **more):
    return subprocess.run(command, capture_output=True, text=True, errors="replace", **more)


# --- what is built once -------------------------------------------------------------------------------------------------------

def precompiled(name):
    """Headers that all files of a kind begin with, compiled once."""
    folder = BUILD / "headers"
    folder.mkdir(parents=True, exist_ok=True)
    header = folder / f"{name}.hpp"
    text = "".join(f"#include <{h}>\n" for h in HEADERS[name])
    if not header.exists() or header.read_text() != text or not header.with_suffix(".hpp.gch").exists():
        header.write_text(text)
        done = run([compiler(), *FLAGS, "-x", "c++-header", str(header), "-o", f"{header}.gch"])
        if done.returncode:
            sys.exit(done.stderr)
    return header


def is_new(made, dependencies):
    """Whether an object is newer than all files that it was made of."""
    if not made.exists() or not dependencies.exists():
        return False
    names = re.sub(r"\\\n", " ", dependencies.read_text()).split(":", 1)[1].split()
    return all(Path(n).exists() and Path(n).stat().st_mtime <= made.stat().st_mtime for n in names)


def compile_file(source, made, headers, folder=None):
    """Returns what the compiler says if it fails. `folder`: where includes in quotes are looked for first."""
    made.parent.mkdir(parents=True, exist_ok=True)
    command = [compiler(), *FLAGS, *INCLUDES, "-include", str(BUILD / "headers" / f"{headers}.hpp"), "-MMD", "-c", str(source),
               "-o", str(made), f"-DFOAM_TEST_SOURCE=\"{ROOT}\"", f"-DFOAM_TEST_PLUGINS=\"{BUILD}/plugins\"",
               f"-DFOAM_TEST_SHARED=\"{os.environ.get('FOAM_SHARED', '')}\"", "-DFOAM_TEST_BINARY=\"\"",
               "-DFOAM_TEST_FEW"]  # tests that take many samples take fewer
    if folder:
        command[1:1] = ["-iquote", str(folder)]
    done = run(command)
    if done.returncode:
        made.unlink(missing_ok=True)
    return done.stderr if done.returncode else ""


def tests_of(file):
    return [t for t in BELONG[file] if (TESTS / f"{t}.cpp").exists()]


def build(jobs, files):
    """Compiles core's files, and the tests of `files`, where they changed. Tests link what they need of core's archive."""
    record = BUILD / "include" / "foam" / "sdk" / "abi_record.hpp"  # no plugin is loaded
    if not record.exists():
        record.parent.mkdir(parents=True, exist_ok=True)
        record.write_text('#pragma once\n#define FOAM_ABI_LAYOUT "mutation"\n')
    for name in HEADERS:
        precompiled(name)
    names = [p.relative_to(CORE) for p in sorted(CORE.glob("*/src/**/*.cpp"))]
    sources = [(CORE / name, BUILD / "core" / name.with_suffix(".o"), "core") for name in names
               if name.parts[0] in WHOLE or str(name).startswith(LINKED)]
    tests = sorted({t for f in files for t in tests_of(f)})
    sources += [(TESTS / f"{t}.cpp", BUILD / "tests" / f"{t}.o", "tests") for t in tests]
    stale = [s for s in sources if not is_new(s[1], s[1].with_suffix(".d"))]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for (source, _, _), told in zip(stale, pool.map(lambda s: compile_file(*s), stale)):
            if told:
                sys.exit(f"{source} does not compile:\n{told}")
    archive = BUILD / "libcore.a"
    archive.unlink(missing_ok=True)  # what it is made of may have changed though no object has
    done = run(["ar", "rcs", str(archive), *[str(s[1]) for s in sources if s[2] == "core"]])
    if done.returncode:
        sys.exit(done.stderr)


def linked(program, objects, tests):
    """Links the tests; an object that comes before the archive stands in for that of the archive."""
    linker = next((f"-fuse-ld={n}" for n in ("lld", "gold") if shutil.which(f"ld.{n}")), "")
    done = run([compiler(), *([linker] if linker else []), *map(str, objects), *[str(BUILD / "tests" / f"{t}.o") for t in tests],
                str(BUILD / "libcore.a"), *LIBRARIES, "-o", str(program)])
    return done.stderr if done.returncode else ""


# --- mutants ------------------------------------------------------------------------------------------------------------------

def limits(seconds):
    def set_them():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return set_them


def tested(program, seconds):
    """How a test program ends: "passes", the first case that fails, "hangs" or "crashes"."""
    command = [str(program), "--gtest_fail_fast", "--gtest_brief=1"]
    try:
        done = run(command, preexec_fn=limits(seconds), timeout=20 * seconds, cwd=BUILD)
    except subprocess.TimeoutExpired:
        return "hangs"
    if done.returncode == 0:
        return "passes"
    if done.returncode in (-24, -9):
        return "hangs"
    failed = re.search(r"\[  FAILED  \] (\S+)", done.stdout)
    return failed.group(1) if failed else f"crashes ({done.returncode})"


class Bench:
    """The programs of a file's tests, and how long they take on the code as it is."""

    def __init__(self):
        self.seconds = {}

    def limit(self, file):
        tests = tuple(tests_of(file))
        if tests not in self.seconds:
            program = BUILD / "unchanged"
            told = linked(program, [], tests)
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            result = tested(program, 600) if not told else told
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            if result != "passes":
                sys.exit(f"the tests of {file} do not pass on the code as it is: {result}")
            self.seconds[tests] = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            print(f"{file}: its tests take {self.seconds[tests]:.1f} s of CPU time", flush=True)
        return int(4 * self.seconds[tests] + 6)

    def outcome(self, mutant):
        seconds = self.limit(mutant.file)
        folder = BUILD / "mutant"
        folder.mkdir(exist_ok=True)
        source, made, program = folder / Path(mutant.file).name, folder / "mutant.o", folder / "tests"
        source.write_text(mutant.source)
        if compile_file(source, made, "core", (CORE / mutant.file).parent):
            return "does not compile"
        if linked(program, [made], tests_of(mutant.file)):
            return "does not compile"
        return tested(program, seconds)


def mutants_of_all(only):
    found = []
    for file in filter(lambda f: (CORE / f).exists(), BELONG):
        these = mutants_of(file, (CORE / file).read_text(), len(found))  # numbers do not depend on what is chosen
        found += these
    return [m for m in found if not only or any(name in m.file for name in only)]


def equivalents():
    """Mutations that change nothing that can be observed: {(file, line, change): reason} from equivalent.md's tables."""
    known, file = {}, ""
    for line in (HERE / "equivalent.md").read_text().splitlines():
        if line.startswith("## "):
            file = line[3:].strip()
        cells = [c.strip().strip("`").replace("¦", "|") for c in line.strip("|").split(" | ")]
        if line.startswith("| `") and len(cells) == 3:
            for change in cells[1].split("`, `"):
                known[(file, cells[0].strip().strip("`"), change)] = cells[2]
    return known


def reason_of(mutant, known):
    for change in (mutant.change, "*"):
        if reason := known.get((mutant.file, mutant.line_text, change)):
            return reason
    return ""


def summary(results, known):
    rows = ["| file | mutants | found | of these hang | equivalent | survived | found, % |", "|---|---|---|---|---|---|---|"]
    count = {file: Counter() for file in BELONG}
    for mutant, outcome in results:
        kind = ("none" if outcome == "does not compile" else "found" if outcome != "passes"
                else "equivalent" if reason_of(mutant, known) else "survived")
        count[mutant.file][kind] += 1
        count[mutant.file]["hang"] += outcome == "hangs"
    count["all"] = sum(count.values(), Counter())
    for file, c in count.items():
        counted = c["found"] + c["survived"]
        if counted + c["equivalent"]:
            rows.append(f"| {file} | {counted} | {c['found']} | {c['hang']} | {c['equivalent']} | {c['survived']} | "
                        f"{100 * c['found'] / max(counted, 1):.1f} |")
    return "\n".join(rows)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--list", action="store_true", help="print the mutants and end")
    parser.add_argument("--only", action="append", metavar="FILE", help="files of core whose name contains this; may be repeated")
    parser.add_argument("--sample", type=int, metavar="N", help="as many of them, chosen at random")
    parser.add_argument("--seed", type=int, default=1, help="of the choice")
    parser.add_argument("--number", type=int, action="append", metavar="N", help="this mutant; may be repeated")
    parser.add_argument("--survivors", type=Path, metavar="LOG", help="only those that passed according to the log of a run before")
    parser.add_argument("--summarise", type=Path, metavar="LOG", help="print the table of what a log tells, the last outcome of each, and end")
    parser.add_argument("--until", metavar="HH:MM", help="start no mutant after this time of the day, UTC")
    parser.add_argument("--jobs", type=int, default=2, help="compilers at once for what is built once")
    parser.add_argument("--log", type=Path, default=BUILD / "log.txt", help="where each outcome is added")
    parser.add_argument("--results", type=Path, help="write the table of results to this file")
    return parser.parse_args()


def chosen(options):
    mutants = mutants_of_all(options.only)
    if options.number:
        mutants = [m for m in mutants if m.number in options.number]
    if options.survivors:
        passed = {tuple(line.split("\t")[:3]) for line in options.survivors.read_text().splitlines() if line.endswith("\tpasses")}
        known = equivalents()
        mutants = [m for m in mutants if (m.file, m.line_text, m.change) in passed and not reason_of(m, known)]
    if options.sample and options.sample < len(mutants):
        mutants = sorted(random.Random(options.seed).sample(mutants, options.sample), key=lambda m: m.number)
    return mutants


def main():
    options = arguments()
    mutants = chosen(options)
    if options.list:
        print("\n".join(m.name for m in mutants))
        return 0
    if options.summarise:
        told = dict(line.rsplit("\t", 1) for line in options.summarise.read_text().splitlines())
        keys = {m: f"{m.file}\t{m.line_text}\t{m.change}" for m in mutants}
        return report([(m, told[keys[m]]) for m in mutants if keys[m] in told], options)
    os.nice(10)
    BUILD.mkdir(parents=True, exist_ok=True)
    build(options.jobs, {m.file for m in mutants})
    known, bench, results = equivalents(), Bench(), []
    with options.log.open("a") as log:
        for n, mutant in enumerate(mutants):
            if options.until and time.strftime("%H:%M", time.gmtime()) >= options.until:
                break
            begin = time.monotonic()
            outcome = bench.outcome(mutant)
            results.append((mutant, outcome))
            log.write(f"{mutant.file}\t{mutant.line_text}\t{mutant.change}\t{outcome}\n")
            log.flush()
            told = f"{outcome} (equivalent)" if outcome == "passes" and reason_of(mutant, known) else outcome
            print(f"{n + 1}/{len(mutants)} {time.monotonic() - begin:.1f} s {told}: {mutant.name}", flush=True)
    return report(results, options)


def report(results, options):
    """Prints the table and what survived; the exit code says whether enough were found."""
    known = equivalents()
    table = summary(results, known)
    survived = [m for m, outcome in results if outcome == "passes" and not reason_of(m, known)]
    print(table, *[f"survived: {m.name}" for m in survived], sep="\n")
    if options.results:
        options.results.write_text(table + "\n")
    found = [m for m, outcome in results if outcome not in ("passes", "does not compile")]
    return 0 if len(found) >= 0.95 * (len(found) + len(survived)) else 1


if __name__ == "__main__":
    sys.exit(main())
