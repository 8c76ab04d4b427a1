// The files of schemas/ that runs follow.
#pragma once

#include <foam/base/internal/embedded_text.hpp>

namespace foam::inline runtime::schema_files {

extern const EmbeddedText manifest_schema_json;
extern const EmbeddedText spheres_schema_json;

} // namespace foam::runtime::schema_files
