"""The hooks of .pre-commit-hooks.yaml under the real pre-commit, and the lines of docs/guide/in_your_ci.md."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

SOURCE = Path(os.environ["FOAM_TEST_SOURCE"])
EXAMPLES = SOURCE / "docs/examples/ci"
MAKE = ["foam", "run", "robot_spheres.yaml", "--run-dir", "model"]
ROBOT = """<robot name="two_links">
  <link name="base"><collision><geometry><box size="0.4 0.3 0.1"/></geometry></collision></link>
  <link name="arm"><collision><geometry><mesh filename="meshes/arm.obj"/></geometry></collision></link>
  <joint name="turn" type="fixed"><parent link="base"/><child link="arm"/></joint>
</robot>
"""
HAND = """  <link name="hand"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="grip" type="fixed"><parent link="arm"/><child link="hand"/></joint>
</robot>"""
ARM = """v 0 0 0
v 0.1 0 0
v 0 0.1 0
v 0 0 0.1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
"""
RECIPE = """foam: 1
robot: {urdf: robot.urdf}
stages: [spherize.cover]
budget: {spheres: 12}
"""
PASSED, FAILED = "\\.+Passed\n", "\\.+Failed\n"
CERTIFY = r"foam certify: the model covers the robot; if not, make it again"
LOCKED = r"foam run --locked: the model is made of these inputs; if not, make it again"


class Clone:
    """A folder with a repository, and what runs in it: the foam of this build, the pre-commit of PyPI."""

    def __init__(self, folder, programs):
        self.folder = folder
        self.environment = {
            "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}",
            "HOME": str(programs),
            "PRE_COMMIT_HOME": str(programs / "cache"),
            "GIT_CONFIG_NOSYSTEM": "1",
            **{f"GIT_{role}_{what}": "test" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")},
        }
        self.done("git", "init", "--quiet", "--initial-branch=main")

    def run(self, *words):
        words = [str(word) for word in words]
        done = subprocess.run(
            words, cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        return done.returncode, done.stdout

    def done(self, *words):
        code, out = self.run(*words)
        assert code == 0, out
        return out

    def commit(self, text="All"):
        self.done("git", "add", "--all")
        self.done("git", "commit", "--quiet", "--no-verify", "--message", text)

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def change(self, name, old, new):
        text = (self.folder / name).read_text()
        assert old in text
        self.write(name, text.replace(old, new))

    def hooks(self, *words):
        """Run the hooks on what git knows; return the exit code and what pre-commit prints."""
        self.done("git", "add", "--all")
        return self.run("pre-commit", "run", *(words or ["--all-files"]))


@pytest.fixture(scope="module")
def programs(tmp_path_factory):
    """Return a folder with foam, pre-commit and a pip that installs nothing: they are there."""
    if not shutil.which("git"):
        (pytest.fail if os.environ.get("CI") else pytest.skip)("the Debian package git is missing")
    folder = tmp_path_factory.mktemp("programs")
    scripts = {
        "foam": f'exec "{os.environ["FOAM_TEST_BINARY"]}" "$@"',
        "pre-commit": f'exec "{sys.executable}" -m pre_commit "$@"',
        "pip": 'case "$*" in "install https://"*"/foam_spheres-"*".whl pre-commit") ;; *) exit 1 ;; esac',
    }
    for name, line in scripts.items():
        (folder / name).write_text(f"#!/bin/sh\n{line}\n")
        (folder / name).chmod(0o755)
    return folder


@pytest.fixture(scope="module")
def published(programs, tmp_path_factory):
    """Return a repository with the hooks, and the release that the page's example names."""
    clone = Clone(tmp_path_factory.mktemp("foam"), programs)
    shutil.copy(SOURCE / ".pre-commit-hooks.yaml", clone.folder)
    clone.commit()
    clone.done("git", "tag", "v0.3.0")
    return clone.folder


@pytest.fixture
def robot(published, programs, tmp_path):
    """Return a repository with a robot, its model and the page's hooks."""
    clone = Clone(tmp_path, programs)
    files = {"robot.urdf": ROBOT, "meshes/arm.obj": ARM, "robot_spheres.yaml": RECIPE, ".gitignore": "runs/\n"}
    for name, text in files.items():
        clone.write(name, text)
    config = (EXAMPLES / "pre-commit-config.yaml").read_text()
    assert "https://github.com/OWNER/foam" in config
    clone.write(".pre-commit-config.yaml", config.replace("https://github.com/OWNER/foam", str(published)))
    clone.done(*MAKE)
    clone.commit()
    return clone


def test_a_model_that_is_right_passes(robot):
    code, out = robot.hooks()
    assert code == 0, out
    assert re.fullmatch(f".*{CERTIFY}{PASSED}{LOCKED}{PASSED}", out, re.DOTALL), out
    assert robot.done("git", "status", "--porcelain") == ""


@pytest.mark.parametrize(
    ("file", "old", "new", "link", "stale"),
    [
        ("robot.urdf", "0.4 0.3 0.1", "0.5 0.3 0.1", "base", "input file robot.urdf"),
        ("meshes/arm.obj", "v 0 0 0.1", "v 0 0 0.3", "arm ", "mesh file meshes/arm.obj"),
    ],
)
def test_an_uncovered_link_fails_until_the_model_is_made_again(robot, file, old, new, link, stale):
    robot.change(file, old, new)
    code, out = robot.hooks()
    assert code == 1
    row = rf"{link}  +[1-9]\d*\.\d+  .*\nNot certified \(outer\): 1 of 2 links\.\n"
    assert re.search(f"{CERTIFY}{FAILED}.*- exit code: 1\n.*link  growth mm  .*{row}", out, re.DOTALL), out
    other = f"  {stale}: the manifest has .*\nremedy: "
    assert re.search(f"{LOCKED}{FAILED}.*- exit code: 2\n.*{other}", out, re.DOTALL), out

    robot.done(*MAKE)
    code, out = robot.hooks()
    assert code == 0, out


def test_a_new_link_fails(robot):
    robot.change("robot.urdf", "</robot>", HAND)
    code, out = robot.hooks()
    assert code == 1
    assert "hand  it has no elements\n" in out


def test_a_stale_model_that_still_covers_fails(robot):
    robot.change("robot.urdf", "0.4 0.3 0.1", "0.3 0.3 0.1")
    code, out = robot.hooks()
    assert code == 1
    assert re.search(f"{CERTIFY}{PASSED}{LOCKED}{FAILED}", out), out


def test_another_recipe_fails(robot):
    robot.change("robot_spheres.yaml", "spheres: 12", "spheres: 9")
    code, out = robot.hooks()
    assert code == 1
    assert re.search(f"{CERTIFY}{PASSED}{LOCKED}{FAILED}", out), out
    assert "  setting budget.spheres: the manifest has 12, the recipe has 9\n" in out


def test_a_model_changed_by_hand_fails(robot):
    model = robot.folder / "model/robot_spheres.urdf"
    changed, count = re.subn(r'<sphere radius="[\d.]+"', '<sphere radius="0.01"', model.read_text(), count=1)
    assert count == 1
    model.write_text(changed)
    code, out = robot.hooks()
    assert code == 1
    assert re.search(f"{CERTIFY}{FAILED}", out), out


def test_git_refuses_the_commit(robot):
    robot.done("pre-commit", "install")
    robot.change("robot.urdf", "0.4 0.3 0.1", "0.5 0.3 0.1")
    code, out = robot.run("git", "commit", "--all", "--message", "A longer base")
    assert code == 1
    assert re.search(f"{CERTIFY}{FAILED}", out), out


def test_without_foam_the_message_names_it(robot, programs, tmp_path_factory):
    fewer = tmp_path_factory.mktemp("fewer")
    shutil.copy(programs / "pre-commit", fewer)
    robot.environment["PATH"] = f"{fewer}{os.pathsep}{Path(shutil.which('git')).parent}"
    if shutil.which("foam", path=robot.environment["PATH"]):
        pytest.skip("foam lies beside git")
    code, out = robot.hooks()
    assert code == 1
    assert "Executable `foam` not found" in out


def lines_of(name):
    """Return the shell lines and the variables of an example for continuous integration."""
    job = yaml.safe_load((EXAMPLES / name).read_text())
    if name == "gitlab.yaml":
        return job["model"]["script"], job["model"]["variables"]
    job = job["jobs"]["model"]
    return [step["run"] for step in job["steps"] if "run" in step], job["env"]


@pytest.mark.parametrize("name", ["github.yaml", "gitlab.yaml"])
@pytest.mark.parametrize("right", [True, False])
def test_continuous_integration(robot, name, right):
    lines, variables = lines_of(name)
    if not right:
        robot.change("robot.urdf", "0.4 0.3 0.1", "0.5 0.3 0.1")
        robot.commit()
    robot.environment |= variables
    code, out = robot.run("bash", "-e", "-c", "\n".join(lines))
    assert code == (0 if right else 1), out
    assert re.search(f"{CERTIFY}{PASSED if right else FAILED}", out), out
