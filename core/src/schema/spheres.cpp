#include <foam/host/schemas.hpp>

namespace foam {

std::string spheres_schema() {
    return R"schema({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "$id": "urn:foam:spheres:1",
  "title": "Sphere model of a robot or an object, version 1",
  "description": "Written by write.json, layout links. All lengths are metres; every link's spheres are in that link's frame.",
  "type": "object",
  "required": [
    "foam_spheres",
    "name",
    "robot",
    "guarantee",
    "certified",
    "units",
    "frame",
    "links"
  ],
  "additionalProperties": false,
  "properties": {
    "foam_spheres": {
      "const": 1,
      "description": "Version of this format."
    },
    "name": {
      "type": "string",
      "description": "Name of the recipe."
    },
    "robot": {
      "type": "string",
      "description": "Name of the robot, as its URDF gives it."
    },
    "guarantee": {
      "enum": [
        "outer",
        "inner",
        "fitted"
      ],
      "description": "outer: the geometry is inside the spheres; inner: the spheres are inside the geometry; fitted: neither."
    },
    "certified": {
      "type": "boolean",
      "description": "The guarantee outer or inner is proved for every link."
    },
    "units": {
      "const": "m"
    },
    "frame": {
      "const": "link"
    },
    "links": {
      "type": "object",
      "description": "The links that have spheres, by name.",
      "additionalProperties": {
        "$ref": "#/$defs/link"
      }
    }
  },
  "$defs": {
    "link": {
      "type": "object",
      "required": [
        "spheres",
        "groups"
      ],
      "additionalProperties": false,
      "properties": {
        "spheres": {
          "type": "array",
          "minItems": 1,
          "description": "The finest level of all groups, one after the other: x, y, z, radius.",
          "items": {
            "type": "array",
            "prefixItems": [
              {
                "type": "number"
              },
              {
                "type": "number"
              },
              {
                "type": "number"
              },
              {
                "$ref": "#/$defs/radius"
              }
            ],
            "minItems": 4,
            "items": false
          }
        },
        "groups": {
          "type": "array",
          "minItems": 1,
          "description": "One group for the whole link, or one for each of its collision elements.",
          "items": {
            "$ref": "#/$defs/group"
          }
        }
      }
    },
    "group": {
      "type": "object",
      "required": [
        "geometries",
        "measures",
        "levels"
      ],
      "additionalProperties": false,
      "properties": {
        "geometries": {
          "type": "array",
          "items": {
            "type": "string"
          },
          "description": "What the spheres stand for: mesh references as written in the URDF, or kinds of primitives."
        },
        "measures": {
          "$ref": "#/$defs/measures"
        },
        "levels": {
          "type": "array",
          "minItems": 1,
          "description": "Coarse to fine; every level stands for the whole geometry. The first has no parents.",
          "items": {
            "type": "array",
            "minItems": 1,
            "items": {
              "$ref": "#/$defs/sphere"
            }
          }
        }
      }
    },
    "sphere": {
      "type": "object",
      "required": [
        "center",
        "radius"
      ],
      "additionalProperties": false,
      "properties": {
        "center": {
          "type": "array",
          "items": {
            "type": "number"
          },
          "minItems": 3,
          "maxItems": 3
        },
        "radius": {
          "$ref": "#/$defs/radius"
        },
        "parent": {
          "type": "integer",
          "minimum": 0,
          "description": "Index of a sphere in the level before."
        }
      }
    },
    "radius": {
      "type": "number",
      "exclusiveMinimum": 0
    },
    "figure": {
      "type": [
        "number",
        "null"
      ],
      "description": "null: infinite, or not measured."
    },
    "measures": {
      "type": "object",
      "description": "Of the finest level. S: the solid as the URDF gives it; U: the union of the spheres.",
      "required": [
        "spheres",
        "area",
        "volume",
        "covered",
        "gap",
        "excess",
        "excess_error",
        "excess_volume",
        "excess_volume_error",
        "missing",
        "missing_error",
        "missing_volume",
        "missing_volume_error",
        "exposed_area",
        "protrusion_max",
        "protrusion_mean",
        "certified"
      ],
      "additionalProperties": false,
      "properties": {
        "spheres": {
          "type": "integer",
          "minimum": 0
        },
        "area": {
          "$ref": "#/$defs/figure",
          "description": "Of the surface of S, m²."
        },
        "volume": {
          "$ref": "#/$defs/figure",
          "description": "of S, m³"
        },
        "covered": {
          "$ref": "#/$defs/figure",
          "description": "share of the surface of S inside U"
        },
        "gap": {
          "$ref": "#/$defs/figure",
          "description": "largest distance from the surface of S to U, m"
        },
        "excess": {
          "$ref": "#/$defs/figure",
          "description": "vol(U without S) / vol(S)"
        },
        "excess_error": {
          "$ref": "#/$defs/figure",
          "description": "standard error of excess"
        },
        "excess_volume": {
          "$ref": "#/$defs/figure",
          "description": "vol(U without S), m³"
        },
        "excess_volume_error": {
          "$ref": "#/$defs/figure",
          "description": "standard error of excess_volume, m³"
        },
        "missing": {
          "$ref": "#/$defs/figure",
          "description": "vol(S without U) / vol(S)"
        },
        "missing_error": {
          "$ref": "#/$defs/figure",
          "description": "standard error of missing"
        },
        "missing_volume": {
          "$ref": "#/$defs/figure",
          "description": "vol(S without U), m³"
        },
        "missing_volume_error": {
          "$ref": "#/$defs/figure",
          "description": "standard error of missing_volume, m³"
        },
        "exposed_area": {
          "$ref": "#/$defs/figure",
          "description": "area of the surface of U outside S, m²"
        },
        "protrusion_max": {
          "$ref": "#/$defs/figure",
          "description": "largest distance from the exposed surface of U to S, m"
        },
        "protrusion_mean": {
          "$ref": "#/$defs/figure",
          "description": "mean of it by area, m"
        },
        "certified": {
          "type": "boolean",
          "description": "the guarantee is proved: outer, gap = 0; inner, no sphere sticks out"
        }
      }
    }
  }
}
)schema";
}

} // namespace foam
