// The files of report/resources, as text within the library; cmake/EmbedText.cmake puts them there.
#pragma once

#include <string_view>

namespace foam::report {

struct Resource {
    std::string_view text;
    std::string_view sha256; ///< of the text, hexadecimal
};

extern const Resource page_css;    ///< of all pages
extern const Resource page_js;     ///< theme and tables that can be sorted
extern const Resource renderer_js; ///< meshes and spheres by WebGL 2
extern const Resource viewer_js;   ///< what the reader turns, shows and hides

} // namespace foam::report
