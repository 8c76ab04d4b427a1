#include <foam/view/session.hpp>

#include "session_work.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/ladder.hpp>
#include <foam/recipe/quick_recipe.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

namespace foam::inline view {
namespace {

constexpr double farthest = 1e6;          ///< m
constexpr double seconds_of_search = 0.7; ///< of a link; growth and proof follow within the second
constexpr std::size_t most_of_link = 10'000, most_of_model = 1'000'000;

[[noreturn]] void refuse(const std::string& why) {
    throw Error(ErrorCode::usage, why);
}

Sphere checked(const Sphere& sphere) {
    const Vec3& c = sphere.center;
    if (!is_finite(c) || !std::isfinite(sphere.radius) || !(sphere.radius > 0) ||
        std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z), sphere.radius}) > farthest) {
        refuse("a sphere needs a radius above 0, and may be at most 1e6 m large and far");
    }
    return sphere;
}

ModelState state_of(const std::vector<std::vector<Sphere>>& spheres) {
    ModelState state;
    for (const std::vector<Sphere>& link : spheres) {
        state.push_back(std::make_shared<const LinkState>(LinkState{link, std::vector<bool>(link.size()), 1}));
    }
    return state;
}

std::vector<std::vector<Sphere>> spheres_in(const ModelState& state) {
    std::vector<std::vector<Sphere>> spheres;
    for (const auto& link : state) {
        spheres.push_back(link->spheres);
    }
    return spheres;
}

/// Returns the largest candidate count below `count`, at least 1.
std::size_t rung_below(std::size_t count) {
    std::size_t below = 1;
    for (std::size_t rung = 1; rung < count; rung = rung_above(rung)) {
        below = rung;
    }
    return below;
}

/// Returns whether a link of the state has pins or a weight, which a search of the whole robot depends on.
bool is_shaped(const ModelState& state) {
    return std::any_of(state.begin(), state.end(), [](const auto& link) {
        return link->weight != 1 || std::find(link->pinned.begin(), link->pinned.end(), true) != link->pinned.end();
    });
}

} // namespace

struct [[gnu::visibility("hidden")]] Session::Data {
    Data(Subject given, SubjectOptions with, Registry & known, std::filesystem::path where)
        : subject(std::move(given)), options(std::move(with)), registry(known), folder(std::move(where)),
          history(states_of(subject)), originals(subject.robots.size()) {}

    static std::vector<ModelState> states_of(const Subject& subject) {
        std::vector<ModelState> states;
        for (const ViewedModel& model : subject.models) {
            states.push_back(state_of(model.spheres));
        }
        return states;
    }

    ModelState state(std::size_t model) const {
        const std::lock_guard lock(mutex);
        if (model >= history.now().size()) {
            refuse(fmt::format("there is no model {}", model));
        }
        return history.now()[model];
    }

    void require_version(std::size_t version) const {
        const std::lock_guard lock(mutex);
        if (version != history.version()) {
            refuse("the model was changed in another window; remedy: reload the page");
        }
    }

    const ViewedRobot& robot_of(std::size_t model) const {
        if (model >= subject.models.size()) {
            refuse(fmt::format("there is no model {}", model));
        }
        return subject.robots[subject.models[model].robot];
    }

    /// Returns the original geometry of the model's robot, read at the first call; null if it is not known.
    std::shared_ptr<const Original> original(std::size_t model) {
        const ViewedRobot& robot = robot_of(model);
        if (!robot.judged) {
            return nullptr;
        }
        const std::lock_guard lock(reading);
        auto& known = originals[subject.models[model].robot];
        if (!known) {
            known = std::make_shared<const Original>(original_of(robot, options, registry));
        }
        return known;
    }

    /// Returns the solid of a link; null if its geometry is not known, or it has none.
    std::shared_ptr<const Solid> solid(std::size_t model, std::size_t link) {
        const auto known = original(model);
        if (!known) {
            return nullptr;
        }
        const std::string& name = robot_of(model).robot->links.at(link).name;
        const auto found = std::find_if(known->links.begin(), known->links.end(),
                                        [&](const OriginalLink& l) { return l.link == name; });
        return found == known->links.end() ? nullptr : found->solid;
    }

    std::shared_ptr<const Solid> required_solid(const Edit& edit) {
        auto known = solid(edit.model, edit.link);
        if (!known) {
            refuse("the geometry of this link is not known, so nothing can be searched or proved; remedy: foam view "
                   "ROBOT MODEL, with the robot's original URDF");
        }
        return known;
    }

    std::optional<LinkVerdict> verdict(std::size_t model, const ModelState& state, std::size_t link) {
        if (link >= state.size()) {
            refuse(fmt::format("the robot has no link {}", link));
        }
        const auto known = solid(model, link);
        return known ? std::optional(verdict_of(*known, state[link]->spheres)) : std::nullopt;
    }

    LinkState edited(const Edit& edit, LinkState link);
    ModelState counted(const Edit& edit, const ModelState& state);

    const Subject subject;
    const SubjectOptions options;
    Registry& registry;
    const std::filesystem::path folder;

    mutable std::mutex mutex; ///< of the history
    History history;
    std::mutex changing;                                    ///< held by a change from its beginning to its end
    std::mutex reading;                                     ///< of the originals
    std::vector<std::shared_ptr<const Original>> originals; ///< of each robot
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::vector<Sphere>>> known_counts; ///< robot, count
    std::atomic<bool> stopped = false;
};

LinkState Session::Data::edited(const Edit& edit, LinkState link) {
    using Kind = Edit::Kind;
    const bool of_sphere = edit.kind == Kind::move || edit.kind == Kind::remove || edit.kind == Kind::pin;
    if (of_sphere && edit.index >= link.spheres.size()) {
        refuse(fmt::format("the link has no sphere {}", edit.index));
    }
    const auto at = static_cast<std::ptrdiff_t>(edit.index);
    const auto replace = [&](std::vector<Sphere> spheres, std::size_t kept) {
        link.spheres = std::move(spheres);
        link.pinned.assign(link.spheres.size(), false);
        std::fill_n(link.pinned.begin(), std::min(kept, link.pinned.size()), true);
    };
    const auto search = [&](std::size_t count) {
        const std::vector<Sphere> pinned = pinned_in(link);
        replace(searched_link(*required_solid(edit), count, pinned, seconds_of_search, stopped), pinned.size());
    };
    switch (edit.kind) {
    case Kind::move:
        link.spheres[edit.index] = checked(edit.sphere);
        break;
    case Kind::add:
        if (link.spheres.size() >= most_of_link) {
            refuse(fmt::format("a link has at most {} spheres here", most_of_link));
        }
        link.spheres.push_back(checked(edit.sphere));
        link.pinned.push_back(true);
        break;
    case Kind::remove:
        link.spheres.erase(link.spheres.begin() + at);
        link.pinned.erase(link.pinned.begin() + at);
        break;
    case Kind::pin:
        link.pinned[edit.index] = edit.pinned;
        break;
    case Kind::more:
        search(rung_above(link.spheres.size()));
        link.weight = std::min(2 * link.weight, 1024.0);
        break;
    case Kind::fewer:
        search(rung_below(link.spheres.size()));
        link.weight = std::max(link.weight / 2, 1.0 / 1024);
        break;
    case Kind::again:
        search(std::max<std::size_t>(link.spheres.size(), 1));
        break;
    case Kind::close:
        if (link.spheres.empty()) {
            refuse("there is no sphere that could grow; remedy: add one, or search again");
        }
        link.spheres = closed_link(*required_solid(edit), link.spheres);
        break;
    case Kind::count:
        break; // of the whole model
    }
    return link;
}

ModelState Session::Data::counted(const Edit& edit, const ModelState& state) {
    const ViewedRobot& robot = robot_of(edit.model);
    if (!robot.judged) {
        refuse("the geometry of this robot is not known, so nothing can be searched");
    }
    if (edit.spheres == 0 || edit.spheres > most_of_model) {
        refuse(fmt::format("a model has 1 to {} spheres", most_of_model));
    }
    const bool shaped = is_shaped(state);
    const std::pair key{subject.models[edit.model].robot, edit.spheres};
    auto known = known_counts.find(key);
    std::vector<std::vector<Sphere>> spheres;
    if (!shaped && known != known_counts.end()) {
        spheres = known->second;
    } else {
        spheres = spheres_of(robot, options, registry, edit.spheres, state, &stopped);
        if (!shaped) {
            known_counts[key] = spheres;
        }
    }
    ModelState result = state_of(spheres);
    for (std::size_t l = 0; l < result.size(); ++l) {
        const std::size_t pinned = pinned_in(*state[l]).size(); // the run puts them first
        if (result[l]->spheres == state[l]->spheres) {
            result[l] = state[l];
        } else if (pinned > 0 || state[l]->weight != 1) {
            LinkState link = *result[l];
            link.weight = state[l]->weight;
            std::fill_n(link.pinned.begin(), std::min(pinned, link.pinned.size()), true);
            result[l] = std::make_shared<const LinkState>(std::move(link));
        }
    }
    return result;
}

Session::Session(Subject subject, SubjectOptions options, Registry& registry, std::filesystem::path folder)
    : data_(std::make_unique<Data>(std::move(subject), std::move(options), registry, std::move(folder))) {}
Session::~Session() = default;

const Subject& Session::subject() const {
    return data_->subject;
}

std::size_t Session::version() const {
    const std::lock_guard lock(data_->mutex);
    return data_->history.version();
}

bool Session::can_undo() const {
    const std::lock_guard lock(data_->mutex);
    return data_->history.can_undo();
}

bool Session::can_redo() const {
    const std::lock_guard lock(data_->mutex);
    return data_->history.can_redo();
}

ModelState Session::state(std::size_t model) const {
    return data_->state(model);
}

std::vector<std::size_t> Session::counts(std::size_t robot) const {
    return candidate_counts(data_->subject.robots.at(robot));
}

Change Session::apply(const Edit& edit, std::size_t version) {
    const std::lock_guard changing(data_->changing);
    data_->require_version(version);
    ModelState state = data_->state(edit.model);
    if (edit.kind == Edit::Kind::count) {
        state = data_->counted(edit, state);
    } else if (edit.link >= state.size()) {
        refuse(fmt::format("the robot has no link {}", edit.link));
    } else {
        state[edit.link] = std::make_shared<const LinkState>(data_->edited(edit, *state[edit.link]));
    }
    const std::lock_guard lock(data_->mutex);
    return data_->history.change(edit.model, std::move(state));
}

Change Session::undo(std::size_t version) {
    const std::lock_guard changing(data_->changing);
    data_->require_version(version);
    const std::lock_guard lock(data_->mutex);
    if (!data_->history.can_undo()) {
        refuse("there is nothing to undo");
    }
    return data_->history.undo();
}

Change Session::redo(std::size_t version) {
    const std::lock_guard changing(data_->changing);
    data_->require_version(version);
    const std::lock_guard lock(data_->mutex);
    if (!data_->history.can_redo()) {
        refuse("there is nothing to redo");
    }
    return data_->history.redo();
}

std::optional<LinkVerdict> Session::verdict(std::size_t model, std::size_t link) {
    return data_->verdict(model, data_->state(model), link);
}

std::optional<LinkVerdict> Session::verdict(const Change& change, std::size_t link) {
    return data_->verdict(change.model, change.state, link);
}

LinkVerdicts Session::verdicts(std::size_t model) {
    const ModelState state = data_->state(model);
    const auto original = data_->original(model);
    return original ? verdicts_of(data_->robot_of(model), *original, spheres_in(state)) : LinkVerdicts(state.size());
}

LinkPairs Session::ignored(std::size_t model) {
    const auto original = data_->original(model);
    return ignored_pairs_of(data_->robot_of(model), original ? &*original : nullptr, spheres_in(data_->state(model)),
                            &data_->stopped);
}

std::optional<ModelFigures> Session::figures(std::size_t model) {
    const auto original = data_->original(model);
    return original ? std::optional(figures_of(data_->robot_of(model), *original, spheres_in(data_->state(model))))
                    : std::nullopt;
}

std::vector<SaveFormat> Session::formats() const {
    return save_formats(data_->registry);
}

Saved Session::save(std::size_t model, const std::string& format, const std::string& file, bool replace) {
    const std::filesystem::path target = target_of(data_->folder, file);
    require_free(data_->registry, format, target, inputs_of(data_->subject, data_->options), replace);
    const ViewedRobot& robot = data_->robot_of(model);
    if (!robot.file.empty() && robot.file == data_->options.nameless) {
        refuse_naming(format, robot.file, data_->registry);
    }
    const ModelState state = data_->state(model);
    const auto original = data_->original(model);
    return format == "recipe"
               ? save_recipe(robot, original.get(), data_->options, data_->registry, state, target)
               : save_model(robot, original.get(), data_->registry, state, format, target, data_->stopped);
}

void Session::stop() {
    data_->stopped = true;
}

} // namespace foam::inline view
