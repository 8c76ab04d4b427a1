"""The keys of recipes as a table, made from their JSON Schema."""

# What the page calls the types of JSON.
TYPES = {"string": "text", "object": "map", "array": "list"}
LARGEST = 1 << 53 # bounds beyond are those of the number's type


def resolved(schema, root):
    """A reference to a definition is replaced by it; what stands beside the reference is kept."""
    while "$ref" in schema:
        rest = {key: value for key, value in schema.items() if key != "$ref"}
        schema = root["$defs"][schema["$ref"].removeprefix("#/$defs/")] | rest
    return schema


def alternatives(schema, root):
    """The schema and what it offers as a choice."""
    return [schema] + [resolved(choice, root) for choice in schema.get("anyOf", [])]


def values_of(schema, root):
    words = []
    for choice in alternatives(schema, root):
        if "const" in choice or "enum" in choice:
            words += [f"`{value}`" for value in choice.get("enum", [choice.get("const")])]
        elif "type" in choice:
            kinds = choice["type"] if isinstance(choice["type"], list) else [choice["type"]]
            words += [TYPES.get(kind, kind) + (bounds_of(choice) if kind != "string" else "") for kind in kinds if kind != "null"]
    return ", ".join(dict.fromkeys(words))


def bounds_of(schema):
    low, high = (bound if abs(bound) < LARGEST else None for bound in
                 (schema.get("minimum", LARGEST), schema.get("maximum", LARGEST)))
    if low is None and high is None:
        return ""
    return f" ≥ {low}" if high is None else f" ≤ {high}" if low is None else f" {low} … {high}"


def default_of(schema):
    value = schema.get("default")
    if value is None:
        return ""
    return f"`{str(value).lower() if isinstance(value, bool) else value}`"


def is_stage(key):
    return "." in key


def rows(prefix, schema, root):
    """A row for each key below the schema, and for the keys below them."""
    for choice in alternatives(schema, root):
        for key, value in choice.get("properties", {}).items():
            if not is_stage(key):
                yield from row_of(prefix + key, resolved(value, root), root)
        if isinstance(below := choice.get("additionalProperties"), dict):
            yield from rows(prefix + "NAME.", resolved(below, root), root)


def row_of(key, schema, root):
    text = schema.get("description", "")
    if text:
        yield f"| `{key}` | {values_of(schema, root)} | {default_of(schema)} | {text} |\n".replace("\\", "\\\\")
    yield from rows(key + ".", schema, root)


def keys_of(root):
    """The keys of a recipe that stands for itself, and those that one over another has besides."""
    whole, over = root["$defs"]["recipe"]["properties"], root["$defs"]["extending recipe"]["properties"]
    return {"properties": whole | {key: schema for key, schema in over.items() if key not in whole}}


def page_of(root, made):
    return (f"# Recipe\n\n{made}\nEvery key of a recipe. `NAME` stands for a name of your own: a link or a glob, a joint, a\n"
            "path of keys. The parameters of stages are on the pages of the [stages](stages.md).\n\n"
            "| key | values | default | meaning |\n|---|---|---|---|\n" + "".join(rows("", keys_of(root), root)))
