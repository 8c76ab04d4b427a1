"""JSON is YAML."""

import json


def safe_load(stream):
    return json.load(stream)
