#include "recipes.hpp"

#include <foam/sdk/kinds.hpp>

#include <algorithm>
#include <map>

namespace foam::fuzz {
namespace {

/// The most that is drawn for parameters that buy precision with time, by their names.
double work_limit(const std::string& parameter) {
    static const std::map<std::string, double> limits{
        {"leaves", 1000},    {"numCover", 120}, {"num_samples", 80}, {"initSpheres", 80},   {"minSpheres", 50},
        {"min_samples", 8},  {"minCover", 8},   {"branch", 12},      {"depth", 2},          {"testerLevels", 2},
        {"most", 48},        {"spheres", 12},   {"elements", 12},    {"max_vertices", 200}, {"iterations", 60},
        {"subdivisions", 2}, {"maxOptLevel", 2}};
    const auto found = limits.find(parameter);
    return found == limits.end() ? 1e300 : found->second;
}

/// The least, for those of which a small one takes long.
double work_floor(const std::string& parameter) {
    return parameter == "alpha" ? 0.06 : parameter == "offset" ? 0.01 : parameter == "spacing" ? 0.5 : -1e300;
}

/// Those whose defaults are made for real parts.
bool costly_by_default(const std::string& parameter) {
    return parameter == "numCover" || parameter == "num_samples" || parameter == "initSpheres" ||
           parameter == "minSpheres" || parameter == "alpha" || parameter == "offset";
}

double random_number(Dice& dice, const Parameter& parameter, double usual) {
    const double low = std::max(parameter.low.value_or(-1e9), work_floor(parameter.name)),
                 high = std::min(parameter.high.value_or(1e9), work_limit(parameter.name));
    const double around = dice.chance(0.5) ? dice.magnitude(0.2, 5) * usual : dice.uniform(low, high);
    const double decades = dice.magnitude(std::max(low, high > 0 ? high * 1e-9 : 1e-9), std::max(high, 1e-9));
    const double value = dice.chance(0.1) ? low : dice.chance(0.1) ? high : dice.chance(0.7) ? around : decades;
    return std::clamp(value, low, high);
}

/// The best takes seconds a link: recipes that ask for it have a time limit.
constexpr const char* best_effort = "best";

std::string random_effort(Dice& dice) {
    return dice.chance(0.1) ? best_effort : dice.of({"fast", "normal"});
}

std::string random_value(Dice& dice, const Parameter& parameter) {
    switch (parameter.type) {
    case Parameter::Type::boolean:
        return dice.chance(0.5) ? "true" : "false";
    case Parameter::Type::integer: {
        const auto usual = static_cast<double>(std::get<std::int64_t>(parameter.default_value));
        return std::to_string(static_cast<std::int64_t>(std::round(random_number(dice, parameter, usual))));
    }
    case Parameter::Type::number:
        return text_of(random_number(dice, parameter, std::get<double>(parameter.default_value)));
    case Parameter::Type::choice: // of JSON's layouts one holds a single mesh only
        return parameter.name == "layout"   ? dice.of({"links", "foam"})
               : parameter.name == "effort" ? quoted(random_effort(dice))
                                            : quoted(dice.of(parameter.choices));
    case Parameter::Type::text:
        return parameter.name == "kinds" && dice.chance(0.7)
                   ? quoted(dice.of(
                         {"box, hull", "sphere, capsule, cylinder, box, swept_box, hull", "swept_box", "capsule"}))
                   : quoted(std::get<std::string>(parameter.default_value));
    }
    return "null";
}

class RecipeWriter {
public:
    RecipeWriter(std::uint64_t seed, const Registry& registry, const RecipeInput& input)
        : seed_(seed), dice_(seed), registry_(registry), input_(input) {}

    std::string recipe() {
        text_ = "foam: 1\nname: case\n";
        text_ += input_.robot ? "robot: {urdf: " + input_.file + "}\n" : "mesh: " + input_.file + "\n";
        guarantee_ = dice_.chance(0.7) ? "outer" : dice_.chance(0.6) && !input_.elements ? "inner" : "fitted";
        text_ += "guarantee: " + guarantee_ + "\n";
        if (dice_.chance(0.2)) {
            text_ += "seed: " + std::to_string(dice_.below(1000)) + "\n";
        }
        if (dice_.chance(0.2)) {
            text_ += "per: collision\n";
        }
        if (dice_.chance(0.25)) {
            text_ += std::string("on_error: ") +
                     dice_.of({"skip", "stop", guarantee_ == "inner" ? "skip" : "fallback"}) + "\n";
        }
        loaders();
        stages();
        budget();
        links();
        self_collision();
        pictures();
        outputs();
        return std::move(text_);
    }

private:
    /// Of that kind, in a random order that a further stage leaves as it is.
    std::vector<std::string> stages_of(StageKind kind) const {
        std::vector<std::string> names;
        for (const auto& [name, stage] : registry_.stages()) {
            // Formats of other programs refuse models for reasons of their own: no tool frame, more than one link.
            // Refiners, guarantees and constraints of these recipes are for spheres alone.
            const bool fits = kind != StageKind::spherizer || spheres_alone(stage.info.kinds) != input_.elements;
            if (stage.kind == kind && stage.info.consumer.name.empty() && fits) {
                names.push_back(name);
            }
        }
        std::sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
            return derive_seed(seed_, a) < derive_seed(seed_, b);
        });
        return names;
    }

    /// "{name: value, …}", each parameter with the given share; `where`: a word for the place.
    std::string parameters(const std::string& stage, double share, const std::string& where, std::string text = "") {
        for (const Parameter& parameter : registry_.find(stage)->info.parameters) {
            Dice dice(derive_seed(seed_, where + stage + "." + parameter.name));
            const bool needed = where.empty() && ((parameter.name == "most" && !spheres_) ||
                                                  (costly_by_default(parameter.name) && !dice.chance(0.03)));
            const bool refused = guarantee_ == "fitted" && parameter.name == "objective"; // a conflict
            if ((dice.chance(share) || needed) && !refused) {
                text += (text.empty() ? "" : ", ") + parameter.name + ": " + random_value(dice, parameter);
            }
        }
        return "{" + text + "}";
    }

    void loaders() {
        if (dice_.chance(0.05)) {
            text_ += "loaders: {load.mesh: " + parameters("load.mesh", 0.5, "") + "}\n";
        }
    }

    void stages() {
        spheres_ = dice_.chance(0.75);
        const std::vector<std::string> filters = stages_of(StageKind::mesh_filter),
                                       spherizers = stages_of(StageKind::spherizer);
        text_ += "stages:\n";
        const std::size_t count = dice_.chance(0.5) ? 0 : 1 + dice_.below(3);
        chain_.assign(filters.begin(), filters.begin() + static_cast<std::ptrdiff_t>(std::min(count, filters.size())));
        chain_.push_back(spherizers.at(0));
        for (const std::string& stage : chain_) {
            text_ += "  - " + stage + ": " + parameters(stage, 0.25, "") + "\n";
        }
        if (input_.elements) {
            return;
        }
        Dice dice(derive_seed(seed_, "refiners"));            // of its own: the draws of the seeds on record stay
        text_ += "  - refine.fit: {}\n  - refine.clip: {}\n"; // without them constraints would be broken
        text_ += dice.chance(0.8) ? "  - refine.row: {}\n" : "";
        text_ += dice.chance(0.8) ? "  - refine.split: {}\n" : "";
    }

    void budget() {
        std::vector<std::string> parts;
        shared_ = spheres_;
        if (spheres_) {
            const int least =
                input_.links.size() > 1 && dice_.chance(0.8) ? static_cast<int>(input_.links.size()) - 1 : 0;
            parts.push_back((input_.elements ? "elements: " : "spheres: ") +
                            std::to_string(least + static_cast<int>(dice_.magnitude(1, 13))));
        }
        if (guarantee_ != "inner" && dice_.chance(0.12)) {
            shared_ = true;
            parts.push_back("excess: " + text_of(dice_.magnitude(spheres_ ? 1e-6 : 0.5, 1e6)));
        }
        if (guarantee_ != "inner" && dice_.chance(0.12)) {
            parts.push_back("max_protrusion: " + protrusion());
        }
        if (dice_.chance(0.05) || text_.find(best_effort) != std::string::npos) {
            parts.push_back("time_limit: " + text_of(dice_.magnitude(0.001, 0.3)));
        }
        if (!parts.empty()) {
            text_ += "budget: {" + joined(parts) + "}\n";
        }
        limited_ = spheres_ || parts.empty();
    }

    std::string protrusion() {
        return text_of(dice_.chance(0.1) ? 0 : dice_.chance(0.2) ? dice_.odd_magnitude() : dice_.magnitude(1e-3, 1));
    }

    void links() {
        std::string text;
        if (!limited_ || dice_.chance(0.25)) {
            text += "  \"*\": {" + joined(overrides(!limited_)) + "}\n";
        }
        for (const std::string& link : input_.links) {
            if (dice_.chance(0.15) && link != "*") {
                text += "  " + quoted(link) + ": {" + joined(overrides(false)) + "}\n";
            }
        }
        text_ += text.empty() ? "" : "links:\n" + text;
    }

    std::vector<std::string> overrides(bool limit) {
        std::vector<std::string> parts;
        const int least = dice_.between(1, 3);
        if (limit || dice_.chance(0.5)) {
            parts.push_back("max_spheres: " + std::to_string(dice_.between(3, 12)));
        }
        if (guarantee_ != "inner" && parts.size() > 0 && dice_.chance(0.2)) { // behind max_spheres: else up to 256
            parts.push_back("max_protrusion: " + protrusion());
        }
        if (dice_.chance(0.2)) {
            parts.push_back("min_spheres: " + std::to_string(least));
        }
        if (shared_ && dice_.chance(0.2)) {
            parts.push_back("weight: " + text_of(dice_.of({0.0, 1e-6, 0.5, 2.0, 1e6})));
        }
        if (input_.robot && dice_.chance(0.1)) {
            parts.push_back("skip: " + std::string(dice_.chance(0.7) ? "true" : "false"));
        }
        if (guarantee_ != "inner" && dice_.chance(0.2) && !input_.elements) {
            parts.push_back(clip());
        }
        if (dice_.chance(0.1)) {
            const std::string stage = dice_.of(chain_), changed = parameters(stage, 0.2, "links ");
            if (changed.find(best_effort) == std::string::npos) {
                parts.push_back(stage + ": " + changed);
            }
        }
        return parts;
    }

    std::string clip() {
        std::string planes;
        for (int k = dice_.between(0, 2); k > 0; --k) {
            const auto part = [&] { return text_of(dice_.of({0.0, 1.0, -1.0, 0.5, 1e-9})); };
            const double reach = dice_.chance(0.5) ? dice_.magnitude(1e-6, 1e3) : 1;
            const double offset = dice_.chance(0.3) ? 0 : dice_.sign() * dice_.magnitude(1e-3, 100);
            planes += (planes.empty() ? "" : ", ") + std::string("{normal: [1, ") + part() + ", " + part() +
                      "], offset: " + text_of(offset) + ", reach: " + text_of(reach) + "}";
        }
        return "clip: [" + planes + "]";
    }

    void self_collision() {
        if (!input_.robot || !dice_.chance(0.15)) {
            return;
        }
        std::string pose;
        for (const std::string& joint : input_.moving_joints) {
            if (dice_.chance(0.5)) {
                pose += (pose.empty() ? "" : ", ") + quoted(joint) + ": " + text_of(dice_.uniform(-2, 2));
            }
        }
        text_ += "self_collision: " + (pose.empty() ? "true" : "{pose: {" + pose + "}}") + "\n";
    }

    void pictures() {
        if (dice_.chance(0.02)) {
            text_ += "debug: {meshes: true}\n";
        }
        if (dice_.chance(0.003)) {
            text_ += "snapshots: {size: [64, 48]}\n";
        }
    }

    void outputs() {
        const std::vector<std::string> writers = stages_of(StageKind::writer);
        if (input_.elements) {
            text_ += "outputs:\n  - write.json: {file: elements.json}\n";
            return;
        }
        const std::string judged = dice_.of({"write.urdf", "write.urdf", "write.csv"});
        text_ += "outputs:\n  - " + judged + ": {file: case." + registry_.find(judged)->info.extensions.at(0) + "}\n";
        const std::size_t more = dice_.chance(0.3) ? 1 + dice_.below(2) : 0;
        for (std::size_t k = 0; k < std::min(writers.size(), more); ++k) {
            const std::string file =
                "file: more" + std::to_string(k) + "." + registry_.find(writers[k])->info.extensions.at(0);
            text_ += "  - " + writers[k] + ": " + parameters(writers[k], 0.3, "writer ", file) + "\n";
        }
    }

    static std::string joined(const std::vector<std::string>& parts) {
        std::string text;
        for (const std::string& part : parts) {
            text += (text.empty() ? "" : ", ") + part;
        }
        return text;
    }

    std::uint64_t seed_;
    Dice dice_;
    const Registry& registry_;
    const RecipeInput& input_;
    std::string text_, guarantee_;
    std::vector<std::string> chain_; ///< names of the stages
    bool spheres_ = false, limited_ = false, shared_ = false;
};

} // namespace

std::string random_recipe(std::uint64_t seed, const Registry& registry, const RecipeInput& input) {
    return RecipeWriter(seed, registry, input).recipe();
}

} // namespace foam::fuzz
