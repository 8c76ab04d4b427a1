// The requests of the page, as JSON.
#pragma once

#include <foam/view/session.hpp>

#include <string>

namespace foam::inline view {

/// The answers to the requests of a page; each is the text of a JSON object. They throw Error(usage) for a text that is
/// not the JSON of such a request, and as the session does.
std::string answer_edit(Session& session, const std::string& body);    ///< {"version", "kind", "model", …}
std::string answer_undo(Session& session, const std::string& body);    ///< {"version"}
std::string answer_redo(Session& session, const std::string& body);    ///< {"version"}
std::string answer_save(Session& session, const std::string& body);    ///< {"model", "format", "file", "replace"}
std::string answer_proofs(Session& session, const std::string& body);  ///< {"model"}: of all links
std::string answer_ignored(Session& session, const std::string& body); ///< {"model"}: pairs of links
std::string answer_figures(Session& session, const std::string& body); ///< {"model"}: protrusions of spheres

/// Returns the scene of the session as it is now.
std::string session_scene(Session& session);

} // namespace foam::inline view
