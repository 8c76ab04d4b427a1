// Files that are text within the library; cmake/EmbedText.cmake puts them there.
#pragma once

#include <string_view>

namespace foam::embedded {

struct Text {
    std::string_view text;
    std::string_view sha256; ///< of the text, hexadecimal
};

// report/resources
extern const Text page_css;    ///< of all pages
extern const Text page_js;     ///< theme and tables that can be sorted
extern const Text renderer_js; ///< meshes and spheres by WebGL 2
extern const Text viewer_js;   ///< what the reader turns, shows and hides
// schemas
extern const Text manifest_schema_json;
extern const Text spheres_schema_json;

} // namespace foam::embedded
