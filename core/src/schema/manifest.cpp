#include <foam/host/schemas.hpp>

namespace foam {

std::string manifest_schema() {
    return R"schema({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "$id": "urn:foam:manifest:1",
  "title": "Manifest of a run, version 1",
  "description": "manifest.json in the folder of a run: what it was made from and by, what came out, and what stages gave on the way. All but 'execution' is the same whenever and wherever the run is repeated.",
  "type": "object",
  "required": [
    "foam_manifest",
    "foam_version",
    "libraries",
    "plugins",
    "settings",
    "input",
    "mesh_files",
    "links",
    "certified",
    "total",
    "outputs",
    "debug_meshes",
    "execution"
  ],
  "properties": {
    "foam_manifest": {
      "const": 1,
      "description": "Version of this format."
    },
    "foam_version": {
      "type": "string"
    },
    "libraries": {
      "type": "object",
      "additionalProperties": {
        "type": "string"
      },
      "description": "Versions of the libraries that can change results."
    },
    "plugins": {
      "type": "array",
      "description": "Those whose stages made the outputs.",
      "items": {
        "type": "object",
        "required": [
          "plugin",
          "version",
          "license"
        ],
        "properties": {
          "plugin": {
            "type": "string"
          },
          "version": {
            "type": "string"
          },
          "license": {
            "type": "string"
          },
          "build": {
            "anyOf": [
              {
                "$ref": "#/$defs/digest"
              },
              {
                "type": "null"
              }
            ],
            "description": "Digest of the plugin's file."
          }
        },
        "additionalProperties": false
      }
    },
    "settings": {
      "type": "object",
      "description": "The recipe as it acts, with every default."
    },
    "input": {
      "type": "object",
      "required": [
        "file",
        "digest",
        "bytes"
      ],
      "properties": {
        "file": {
          "type": "string",
          "description": "As the recipe names it."
        },
        "digest": {
          "$ref": "#/$defs/digest"
        },
        "bytes": {
          "$ref": "#/$defs/count"
        },
        "stage": {
          "type": "string"
        },
        "output": {
          "type": "string",
          "description": "Digest of the robot that was read."
        }
      },
      "additionalProperties": false
    },
    "mesh_files": {
      "type": "array",
      "items": {
        "$ref": "#/$defs/file"
      }
    },
    "links": {
      "type": "array",
      "description": "Those with collision geometry, in the robot's order.",
      "items": {
        "$ref": "#/$defs/link"
      }
    },
    "certified": {
      "type": "boolean",
      "description": "The guarantee is proved for all links on what was read back from every written file; which: settings.guarantee. outer: the geometry is inside the spheres; inner: the spheres are inside the geometry; fitted: false."
    },
    "cut": {
      "enum": [
        "time limit",
        "stop"
      ],
      "description": "What ended the search for better spheres before its time; the run may then give others when it is repeated. Absent: nothing did."
    },
    "total": {
      "$ref": "#/$defs/measures"
    },
    "outputs": {
      "type": "array",
      "items": {
        "$ref": "#/$defs/output"
      }
    },
    "debug_meshes": {
      "type": "array",
      "items": {
        "$ref": "#/$defs/file"
      }
    },
    "execution": {
      "type": "object",
      "description": "What differs between repetitions: times, places, the machine.",
      "required": [
        "recipe",
        "input",
        "mesh_files",
        "threads",
        "seconds",
        "cpu_seconds",
        "links",
        "findings"
      ],
      "properties": {
        "recipe": {
          "type": "object",
          "required": [
            "file",
            "digest",
            "extends"
          ],
          "properties": {
            "file": {
              "type": "string"
            },
            "digest": {
              "$ref": "#/$defs/digest"
            },
            "extends": {
              "type": "array",
              "description": "The files that it extends, nearest first.",
              "items": {
                "type": "object",
                "required": [
                  "file",
                  "digest"
                ],
                "properties": {
                  "file": {
                    "type": "string"
                  },
                  "digest": {
                    "$ref": "#/$defs/digest"
                  }
                }
              }
            },
            "variant": {
              "type": "string"
            }
          }
        },
        "input": {
          "type": "object",
          "required": [
            "taken",
            "candidates",
            "file"
          ],
          "properties": {
            "taken": {
              "type": "string"
            },
            "candidates": {
              "type": "array",
              "items": {
                "type": "string"
              }
            },
            "file": {
              "type": "string"
            }
          }
        },
        "threads": {
          "$ref": "#/$defs/count"
        },
        "seconds": {
          "type": "number",
          "minimum": 0
        },
        "cpu_seconds": {
          "type": "number",
          "minimum": 0
        },
        "findings": {
          "type": "array",
          "items": {
            "type": "object",
            "required": [
              "severity",
              "link",
              "stage",
              "message"
            ],
            "properties": {
              "severity": {
                "enum": [
                  "debug",
                  "info",
                  "warning",
                  "error"
                ]
              },
              "link": {
                "type": "string"
              },
              "stage": {
                "type": "string"
              },
              "message": {
                "type": "string"
              }
            }
          }
        },
        "mesh_files": {
          "type": "array",
          "description": "Where the mesh files were found.",
          "items": {
            "type": "string"
          }
        },
        "links": {
          "type": "array",
          "items": {
            "$ref": "#/$defs/timings"
          }
        }
      },
      "additionalProperties": false
    }
  },
  "$defs": {
    "digest": {
      "type": "string",
      "pattern": "^[0-9a-f]{32}$",
      "description": "XXH3, 128 bits."
    },
    "count": {
      "type": "integer",
      "minimum": 0
    },
    "file": {
      "type": "object",
      "required": [
        "file",
        "digest",
        "bytes"
      ],
      "properties": {
        "file": {
          "type": "string"
        },
        "digest": {
          "$ref": "#/$defs/digest"
        },
        "bytes": {
          "$ref": "#/$defs/count"
        },
        "stage": {
          "type": "string"
        }
      },
      "additionalProperties": false
    },
    "output": {
      "type": "object",
      "required": [
        "file",
        "digest",
        "bytes",
        "stage",
        "proofs"
      ],
      "properties": {
        "file": {
          "type": "string"
        },
        "digest": {
          "$ref": "#/$defs/digest"
        },
        "bytes": {
          "$ref": "#/$defs/count"
        },
        "stage": {
          "type": "string"
        },
        "proofs": {
          "type": "array",
          "description": "What the proof on the numbers read back took, for each link for which the guarantee is proved.",
          "items": {
            "type": "object",
            "required": [
              "link",
              "spheres",
              "triangles",
              "pieces",
              "halvings"
            ],
            "properties": {
              "link": {
                "type": "string"
              },
              "spheres": {
                "$ref": "#/$defs/count"
              },
              "triangles": {
                "$ref": "#/$defs/count",
                "description": "Of the surface; round primitives by the polyhedron around them."
              },
              "pieces": {
                "$ref": "#/$defs/count",
                "description": "Triangles and pieces of them that were looked at. inner: 0."
              },
              "halvings": {
                "$ref": "#/$defs/count",
                "description": "Of the smallest piece that was looked at."
              }
            },
            "additionalProperties": false
          }
        }
      },
      "additionalProperties": false
    },
    "link": {
      "type": "object",
      "required": [
        "link",
        "stages"
      ],
      "properties": {
        "link": {
          "type": "string"
        },
        "stages": {
          "type": "array",
          "items": {
            "type": "object",
            "required": [
              "stage",
              "output"
            ],
            "properties": {
              "stage": {
                "type": "string"
              },
              "input": {
                "type": "string"
              },
              "output": {
                "type": "string",
                "description": "Digest of what it gave."
              }
            },
            "additionalProperties": false
          }
        },
        "skipped": {
          "const": true,
          "description": "Left out by the recipe."
        },
        "error": {
          "type": "string",
          "description": "Why it was lost."
        },
        "growth_m": {
          "type": "number",
          "minimum": 0,
          "description": "Largest growth of a radius that cover took."
        },
        "measures": {
          "$ref": "#/$defs/measures"
        },
        "clip": {
          "type": "array",
          "minItems": 1,
          "items": {
            "$ref": "#/$defs/plane"
          },
          "description": "Planes that its spheres were to keep off."
        }
      },
      "additionalProperties": false
    },
    "plane": {
      "type": "object",
      "required": [
        "normal",
        "offset_m",
        "reach_m",
        "reached_m",
        "kept"
      ],
      "properties": {
        "normal": {
          "type": "array",
          "items": {
            "type": "number"
          },
          "minItems": 3,
          "maxItems": 3,
          "description": "Towards the side that is kept off, in the link's frame; of any length."
        },
        "offset_m": {
          "type": "number",
          "description": "Of the plane from the link's origin along the normal."
        },
        "reach_m": {
          "type": "number",
          "exclusiveMinimum": 0,
          "description": "How far beyond the plane spheres may reach."
        },
        "reached_m": {
          "type": "number",
          "description": "How far they do; negative: they end before the plane."
        },
        "kept": {
          "type": "boolean",
          "description": "reached_m is no more than reach_m."
        }
      },
      "additionalProperties": false
    },
    "measures": {
      "type": "object",
      "required": [
        "spheres",
        "certified",
        "gap_m",
        "covered",
        "excess",
        "missing",
        "protrusion_max_m",
        "protrusion_mean_m",
        "volume_m3",
        "area_m2"
      ],
      "properties": {
        "spheres": {
          "$ref": "#/$defs/count"
        },
        "certified": {
          "type": "boolean"
        },
        "gap_m": {
          "type": [
            "number",
            "null"
          ],
          "minimum": 0,
          "description": "How far geometry sticks out of the spheres; null: infinite, without spheres."
        },
        "covered": {
          "type": [
            "number",
            "null"
          ],
          "description": "Share of the surface that is inside."
        },
        "excess": {
          "type": [
            "number",
            "null"
          ],
          "description": "Volume of the spheres outside the link over the link's own; null: infinite, for geometry without a volume."
        },
        "excess_standard_error": {
          "type": [
            "number",
            "null"
          ],
          "minimum": 0
        },
        "missing": {
          "type": [
            "number",
            "null"
          ],
          "description": "Volume of the link outside the spheres over its own."
        },
        "missing_standard_error": {
          "type": [
            "number",
            "null"
          ],
          "minimum": 0
        },
        "protrusion_max_m": {
          "type": [
            "number",
            "null"
          ]
        },
        "protrusion_mean_m": {
          "type": [
            "number",
            "null"
          ]
        },
        "volume_m3": {
          "type": "number"
        },
        "area_m2": {
          "type": "number"
        }
      },
      "additionalProperties": false
    },
    "timings": {
      "type": "object",
      "required": [
        "link",
        "stages"
      ],
      "additionalProperties": false,
      "properties": {
        "link": {
          "type": "string"
        },
        "stages": {
          "type": "array",
          "items": {
            "type": "object",
            "required": [
              "stage",
              "input",
              "seconds",
              "cached",
              "metrics"
            ],
            "additionalProperties": false,
            "properties": {
              "stage": {
                "type": "string"
              },
              "input": {
                "type": "string",
                "description": "The geometry that it worked on."
              },
              "seconds": {
                "type": "number",
                "minimum": 0
              },
              "cached": {
                "type": "boolean",
                "description": "Taken from the cache."
              },
              "metrics": {
                "type": "object",
                "description": "What the stage measured, by name.",
                "additionalProperties": {
                  "type": "object",
                  "required": [
                    "value",
                    "unit"
                  ],
                  "additionalProperties": false,
                  "properties": {
                    "value": {
                      "type": [
                        "number",
                        "null"
                      ]
                    },
                    "unit": {
                      "type": "string"
                    }
                  }
                }
              },
              "change": {
                "$ref": "#/$defs/change"
              }
            }
          }
        }
      }
    },
    "distance": {
      "type": "object",
      "required": [
        "max_m",
        "mean_m"
      ],
      "additionalProperties": false,
      "properties": {
        "max_m": {
          "type": "number",
          "minimum": 0
        },
        "mean_m": {
          "type": "number",
          "minimum": 0
        }
      }
    },
    "change": {
      "type": "object",
      "description": "What a mesh filter did. Distances are sampled, in both directions.",
      "required": [
        "triangles_before",
        "triangles_after",
        "input_to_output",
        "output_to_input",
        "volume_before_m3",
        "volume_after_m3",
        "defects_before",
        "defects_after"
      ],
      "additionalProperties": false,
      "properties": {
        "triangles_before": {
          "$ref": "#/$defs/count"
        },
        "triangles_after": {
          "$ref": "#/$defs/count"
        },
        "input_to_output": {
          "$ref": "#/$defs/distance"
        },
        "output_to_input": {
          "$ref": "#/$defs/distance"
        },
        "volume_before_m3": {
          "type": [
            "number",
            "null"
          ],
          "description": "null: the mesh is not closed and oriented."
        },
        "volume_after_m3": {
          "type": [
            "number",
            "null"
          ]
        },
        "defects_before": {
          "type": "string"
        },
        "defects_after": {
          "type": "string"
        }
      }
    }
  },
  "additionalProperties": false
}
)schema";
}

} // namespace foam
