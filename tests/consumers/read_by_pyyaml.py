"""PyYAML reads the robot files as cuRobo, bubblify, plainmp and Isaac's editor do: numbers are floats with all their
bits, links are texts."""
import yaml


def by_center(spheres):
    return [[*s["center"], s["radius"]] for s in spheres]


def markers(document):
    found = {}
    for marker in document["markers"]:
        at = marker["pose"]["position"]
        found.setdefault(marker["ns"], []).append([at["x"], at["y"], at["z"], marker["scale"]["x"] / 2])
    return found


SPHERES = {
    "curobo": lambda d: {k: by_center(v) for k, v in d["robot_cfg"]["kinematics"]["collision_spheres"].items()},
    "xrdf": lambda d: {k: by_center(v) for k, v in d["geometry"][d["collision"]["geometry"]]["spheres"].items()},
    "lula": lambda d: {k: by_center(v) for entry in d["collision_spheres"] for k, v in entry.items()},
    "bubblify": lambda d: {k: by_center(v) for k, v in d["collision_spheres"].items()},
    "plainmp": lambda d: {k: v["spheres"] for k, v in d["collision_spheres"].items()},
    "markers": markers,
}


WHOLE = {"id", "type", "action", "total_spheres", "links"}  # keys whose values are whole numbers


def wrong_types(value, key=None):
    """Values of another type than a reader expects: keys that are no texts, numbers that are texts or whole."""
    if isinstance(value, dict):
        for name, item in value.items():
            yield from [] if isinstance(name, str) else [f"the key {name!r}"]
            yield from wrong_types(item, name)
    elif isinstance(value, list):
        for item in value:
            yield from wrong_types(item, key)
    elif isinstance(value, str):
        try:
            float(value)
            yield f"{key}: the text {value!r}"
        except ValueError:
            pass
    elif value is None or (isinstance(value, int) and not isinstance(value, bool) and key not in WHOLE):
        yield f"{key}: {value!r}"


def check(folder, truth):
    for name, spheres_of in SPHERES.items():
        document = yaml.safe_load((folder / f"model.{name}").read_text())
        assert not (wrong := list(wrong_types(document))), f"{name}: {wrong}"
        spheres = spheres_of(document)
        assert spheres == truth["spheres"], f"{name}: {spheres}"
        for link, rows in spheres.items():
            assert isinstance(link, str), f"{name}: {link}"
            assert all(isinstance(number, float) for row in rows for number in row), f"{name}, {link}: {rows}"
        if name == "curobo":
            kinematics = document["robot_cfg"]["kinematics"]
            assert isinstance(kinematics["collision_sphere_buffer"], float)
            assert isinstance(kinematics["self_collision_buffer"], dict)
            assert isinstance(kinematics["self_collision_ignore"], dict)
    return f"{len(SPHERES)} files with {sum(map(len, truth['spheres'].values()))} spheres each"
