#include "session_work.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace foam::inline view {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kinds{"move", "add", "remove", "pin", "more", "fewer", "again", "close", "count"};

[[noreturn]] void refuse_request(const std::string& why) {
    throw Error(ErrorCode::usage, why);
}

Json parsed(const std::string& body) {
    Json json = Json::parse(body, nullptr, false);
    if (!json.is_object()) {
        refuse_request("the request is not a JSON object");
    }
    return json;
}

const Json& at(const Json& json, const char* key) {
    const auto found = json.find(key);
    if (found == json.end()) {
        refuse_request(fmt::format("the request has no '{}'", key));
    }
    return *found;
}

std::size_t natural(const Json& json, const char* key) {
    const Json& value = at(json, key);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 1'000'000'000'000) {
        refuse_request(fmt::format("'{}' is to be a natural number", key));
    }
    return value.get<std::size_t>();
}

std::string text(const Json& json, const char* key) {
    const Json& value = at(json, key);
    if (!value.is_string()) {
        refuse_request(fmt::format("'{}' is to be a text", key));
    }
    return value.get<std::string>();
}

bool truth(const Json& json, const char* key) {
    const Json& value = at(json, key);
    if (!value.is_boolean()) {
        refuse_request(fmt::format("'{}' is to be true or false", key));
    }
    return value.get<bool>();
}

Sphere sphere(const Json& json) {
    const Json& value = at(json, "sphere");
    const auto is_number = [](const Json& number) { return number.is_number(); };
    if (!value.is_array() || value.size() != 4 || !std::all_of(value.begin(), value.end(), is_number)) {
        refuse_request("'sphere' is to be four numbers: x, y, z, radius");
    }
    return {{value[0].get<double>(), value[1].get<double>(), value[2].get<double>()}, value[3].get<double>()};
}

Edit edit_of(const Json& json) {
    using Kind = Edit::Kind;
    const std::string word = text(json, "kind");
    const auto kind = std::find(kinds.begin(), kinds.end(), word);
    if (kind == kinds.end()) {
        refuse_request(fmt::format("there is no edit '{}'", shown(word)));
    }
    Edit edit;
    edit.kind = static_cast<Kind>(kind - kinds.begin());
    edit.model = natural(json, "model");
    if (edit.kind == Kind::count) {
        edit.spheres = natural(json, "spheres");
        return edit;
    }
    edit.link = natural(json, "link");
    if (edit.kind == Kind::move || edit.kind == Kind::remove || edit.kind == Kind::pin) {
        edit.index = natural(json, "index");
    }
    if (edit.kind == Kind::move || edit.kind == Kind::add) {
        edit.sphere = sphere(json);
    }
    if (edit.kind == Kind::pin) {
        edit.pinned = truth(json, "pinned");
    }
    return edit;
}

Json link_json(const LinkState& link) {
    Json spheres = Json::array();
    for (const Sphere& s : link.spheres) {
        spheres.push_back({s.center.x, s.center.y, s.center.z, s.radius});
    }
    return {{"spheres", std::move(spheres)}, {"pinned", link.pinned}, {"weight", link.weight}};
}

Json verdict_json(const std::optional<LinkVerdict>& verdict) {
    return verdict ? json_of<Json>(*verdict) : Json();
}

Json standing(std::size_t version, bool undo, bool redo) {
    return {{"version", version}, {"undo", undo}, {"redo", redo}};
}

/// Links whose verdict is returned with a change. The page asks for the others, so that a robot's change is drawn at
/// once.
constexpr std::size_t most_verdicts = 2;

std::string change_json(Session& session, const Change& change) {
    Json json = standing(change.version, change.can_undo, change.can_redo), links = Json::object();
    for (const std::size_t l : change.links) {
        Json link = link_json(*change.state[l]);
        if (change.links.size() <= most_verdicts) {
            link["verdict"] = verdict_json(session.verdict(change, l));
        }
        links[std::to_string(l)] = std::move(link);
    }
    json["model"] = change.model;
    json["links"] = std::move(links);
    return json.dump();
}

} // namespace

std::string answer_edit(Session& session, const std::string& body) {
    const Json json = parsed(body);
    return change_json(session, session.apply(edit_of(json), natural(json, "version")));
}

std::string answer_undo(Session& session, const std::string& body) {
    return change_json(session, session.undo(natural(parsed(body), "version")));
}

std::string answer_redo(Session& session, const std::string& body) {
    return change_json(session, session.redo(natural(parsed(body), "version")));
}

std::string answer_save(Session& session, const std::string& body) {
    const Json json = parsed(body);
    const Saved saved =
        session.save(natural(json, "model"), text(json, "format"), text(json, "file"), truth(json, "replace"));
    Json answer{{"files", Json::array()}, {"statement", saved.statement}};
    for (const auto& file : saved.files) {
        answer["files"].push_back(shown(file.string()));
    }
    return answer.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string answer_proofs(Session& session, const std::string& body) {
    Json json{{"version", session.version()}, {"verdicts", Json::array()}};
    for (const std::optional<LinkVerdict>& verdict : session.verdicts(natural(parsed(body), "model"))) {
        json["verdicts"].push_back(verdict_json(verdict));
    }
    return json.dump();
}

std::string answer_ignored(Session& session, const std::string& body) {
    const std::size_t version = session.version();
    return Json{{"version", version}, {"ignored", session.ignored(natural(parsed(body), "model"))}}.dump();
}

std::string answer_figures(Session& session, const std::string& body) {
    Json json{{"version", session.version()}, {"protrusions", Json()}};
    if (const std::optional<ModelFigures> figures = session.figures(natural(parsed(body), "model"))) {
        json["protrusions"] = Json::array();
        for (const std::vector<double>& link : figures->protrusions) {
            Json numbers = Json::array();
            for (const double value : link) {
                numbers.push_back(std::isfinite(value) ? Json(value) : Json());
            }
            json["protrusions"].push_back(std::move(numbers));
        }
    }
    return json.dump();
}

std::string session_scene(Session& session) {
    const Subject& subject = session.subject();
    // The version is read first: if a change comes between, the page has to be loaded again before it can change
    // anything.
    Json about = standing(session.version(), session.can_undo(), session.can_redo()), formats = Json::array(),
         counts = Json::array(), links = Json::array();
    for (const SaveFormat& format : session.formats()) {
        formats.push_back({{"name", format.name}, {"extension", format.extension}, {"reader", format.reader}});
    }
    for (std::size_t r = 0; r < subject.robots.size(); ++r) {
        counts.push_back(session.counts(r));
    }
    std::vector<SceneModel> models;
    for (std::size_t m = 0; m < subject.models.size(); ++m) {
        const ModelState state = session.state(m);
        SceneModel model{.name = subject.models[m].file.filename().string(),
                         .format = subject.models[m].format,
                         .robot = subject.models[m].robot,
                         .steps = {{}},
                         .at = 0,
                         .ignored = {}};
        Json of_model = Json::array();
        for (const auto& link : state) {
            model.steps[0].spheres.push_back(link->spheres);
            of_model.push_back({{"pinned", link->pinned}, {"weight", link->weight}});
        }
        links.push_back(std::move(of_model));
        models.push_back(std::move(model));
    }
    about["formats"] = std::move(formats);
    about["counts"] = std::move(counts);
    about["links"] = std::move(links);
    return scene_bytes(subject, models, about.dump());
}

} // namespace foam::inline view
