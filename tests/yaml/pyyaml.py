"""PyYAML reads foam's numbers as floats with all their bits, and its names as texts."""
import subprocess
import sys

try:
    import yaml
except ImportError as error:
    print(f"skipped: {error}; package: python3-yaml")
    sys.exit(77)

entries = yaml.safe_load(subprocess.run(sys.argv[1], capture_output=True, check=True, text=True).stdout)
wrong = []
for value, text, kind in entries:
    if kind == "number" and not (isinstance(value, float) and value == float(text) and repr(value) == repr(float(text))):
        wrong.append((value, text))
    if kind == "name" and not (isinstance(value, str) and "_" + value == text):
        wrong.append((value, text))
print(f"{len(entries)} values, wrong: {wrong}")
sys.exit(1 if wrong else 0)
