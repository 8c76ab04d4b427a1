// Text files inside the library, from cmake/EmbedText.cmake.
#pragma once

#include <string_view>

namespace foam::embedded {

struct Text {
    std::string_view text;
    std::string_view sha256; ///< of the text, hexadecimal
};

// report/resources
extern const Text page_css;    ///< of all pages
extern const Text page_js;     ///< colour theme and sortable tables
extern const Text renderer_js; ///< meshes and spheres with WebGL 2
extern const Text viewer_js;   ///< controls of the viewer
// schemas
extern const Text manifest_schema_json;
extern const Text spheres_schema_json;

} // namespace foam::embedded
