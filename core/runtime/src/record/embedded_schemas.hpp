// The files of schemas/ but for that of recipes.
#pragma once

#include <foam/base/internal/embedded_text.hpp>

namespace foam::inline runtime::schema_files {

extern const EmbeddedText manifest_schema_json;
extern const EmbeddedText spheres_schema_json;
// schemas/commands
extern const EmbeddedText approximate_schema_json;
extern const EmbeddedText batch_schema_json;
extern const EmbeddedText cache_schema_json;
extern const EmbeddedText certify_schema_json;
extern const EmbeddedText check_schema_json;
extern const EmbeddedText compare_schema_json;
extern const EmbeddedText describe_schema_json;
extern const EmbeddedText evaluate_schema_json;
extern const EmbeddedText formats_schema_json;
extern const EmbeddedText info_schema_json;
extern const EmbeddedText plan_schema_json;
extern const EmbeddedText plugins_schema_json;
extern const EmbeddedText run_schema_json;
extern const EmbeddedText schema_schema_json;
extern const EmbeddedText self_collision_schema_json;
extern const EmbeddedText spherize_schema_json;
extern const EmbeddedText stages_schema_json;
extern const EmbeddedText verify_schema_json;
extern const EmbeddedText version_schema_json;

} // namespace foam::runtime::schema_files
