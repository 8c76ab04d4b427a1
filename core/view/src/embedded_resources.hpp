// Style, script and body of the page: the files of resources/.
#pragma once

#include <foam/base/internal/embedded_text.hpp>

namespace foam::inline view::resources {

extern const EmbeddedText view_css;  ///< style
extern const EmbeddedText view_html; ///< what stands in the body
extern const EmbeddedText view_js;   ///< the report's renderer and the modules, as one script

} // namespace foam::inline view::resources
