"""Runs a file of tests by pytest.

run_tests.py FILE [PYTHON]   by another Python, with packages of PyPI; 0: passed; 1: failed; 77: a module that it needs is missing
FOAM_TEST_RESULTS names the file for the results of all tests, as JUnit XML.
"""
import importlib.util
import os
import sys
import tempfile

SKIPPED = 77
OF_BENCH = ["pandas", "matplotlib", "yaml"]
NEEDED = {"arrays_test.py": ["hypothesis"], **{f"bench_{part}_test.py": OF_BENCH for part in ("parts", "reading", "running")}}

if __name__ == "__main__":
    file = sys.argv[1]
    if len(sys.argv) > 2:
        if os.path.exists(sys.argv[2]):
            os.execv(sys.argv[2], [sys.argv[2], sys.argv[0], file])
        print("skipped: packages of PyPI are missing" + (", which continuous integration needs" if os.environ.get("CI") else ""))
        sys.exit(1 if os.environ.get("CI") else SKIPPED)
    needed = ["numpy", "pytest", *next((more for name, more in NEEDED.items() if file.endswith(name)), [])]
    missing = [name for name in needed if not importlib.util.find_spec(name)]
    if missing:
        print(f"skipped: no module {', '.join(missing)}")
        sys.exit(SKIPPED)
    import pytest

    with tempfile.TemporaryDirectory() as folder:  # nothing of the home folder, nothing left beside the tests
        os.environ |= {"XDG_CACHE_HOME": folder, "HYPOTHESIS_STORAGE_DIRECTORY": folder}
        words = ["-q", "-rs", "-p", "no:cacheprovider", "--durations=3", "--basetemp", f"{folder}/tests", file]
        if results := os.environ.get("FOAM_TEST_RESULTS"):
            words.append(f"--junitxml={results}")
        code = pytest.main(words)
    sys.exit(code)
