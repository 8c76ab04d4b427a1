// Style and scripts of pages: the files of resources/.
#pragma once

#include <foam/base/internal/embedded_text.hpp>

namespace foam::inline report::resources {

extern const EmbeddedText camera_js;   ///< where the viewer looks from
extern const EmbeddedText page_css;    ///< of all pages
extern const EmbeddedText page_js;     ///< colour theme and sortable tables
extern const EmbeddedText palette_js;  ///< colours
extern const EmbeddedText renderer_js; ///< meshes and spheres with WebGL 2
extern const EmbeddedText viewer_js;   ///< controls of the viewer

} // namespace foam::report::resources
