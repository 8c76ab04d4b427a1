// JSON and YAML. All formats have links with lists of spheres. They differ in the place of these lists and in the form
// of a sphere.
#include "formats.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/recipe/internal/value.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace foam::inline judge::model_formats {
namespace {

using reading::Place;
using reading::Value;
using Kind = reading::Value::Kind;

constexpr reading::TextKind sphere_file{.name = "sphere file", .most_bytes = 64'000'000};

class TreeReader {
public:
    explicit TreeReader(SphereFile& result) : result_(result) {}

    void read(const Value& root) {
        if (root.is(Kind::list)) {
            original_list(root);
            return;
        }
        if (!root.is(Kind::map)) {
            unknown(root);
        }
        const Value* robot = root.find("robot_cfg");
        const Value* kinematics = robot ? robot->find("kinematics") : root.find("kinematics");
        const Value& spheres_holder = kinematics ? *kinematics : root;
        if (root.find("foam_spheres")) {
            foam_links(root);
        } else if (const Value* format = root.find("format"); format && format->text == "xrdf") {
            xrdf(root);
        } else if (const Value* spheres = spheres_holder.find("collision_spheres")) {
            collision_spheres(*spheres, spheres_holder, kinematics != nullptr);
        } else if (root.find("centers") && root.find("radii")) {
            result_.format = "MorphIt JSON";
            columns(root, "");
        } else if (const Value* links = root.find("spheres"); links && links->is(Kind::map)) {
            result_.format = "spheres by link";
            for_each(*links, [&](const std::string& link, const Value& list) { add(link, list); });
        } else {
            map_of_links(root);
        }
    }

private:
    [[noreturn]] void fail(const Value& at, const std::string& why) const {
        throw Error(ErrorCode::input,
                    fmt::format("{}:{}:{}: {}", result_.file.string(), at.where.line, at.where.column, shown(why)));
    }
    [[noreturn]] void unknown(const Value& at) const {
        fail(at, "no sphere model is known that looks like this; read are URDF, the JSON, CSV and PLY of foam, the "
                 "database of CoMMALab/foam, cuRobo, Lula, bubblify and plainmp YAML, XRDF, MorphIt, ballpark and "
                 "pyroki JSON, and rows of numbers");
    }

    template <class Body> void for_each(const Value& map, Body&& body) const {
        if (!map.is(Kind::map)) {
            fail(map, fmt::format("expected a map of links, got {}", map.description()));
        }
        for (std::size_t i = 0; i < map.keys.size(); ++i) {
            body(map.keys[i].text, map.items[i]);
        }
    }

    const Value& at(const Value& map, std::string_view key) const {
        const Value* value = map.is(Kind::map) ? map.find(key) : nullptr;
        if (!value) {
            fail(map, fmt::format("expected a map with the key '{}', got {}", key,
                                  map.is(Kind::map) ? "one without" : map.description()));
        }
        return *value;
    }

    const Value& list(const Value& value, std::string_view what) const {
        if (!value.is(Kind::list)) {
            fail(value, fmt::format("expected {}, got {}", what, value.description()));
        }
        return value;
    }

    double number(const Value& value) const {
        const bool whole = value.is(Kind::integer);
        const double result = whole ? static_cast<double>(value.whole) : value.real;
        if ((!whole && !value.is(Kind::number)) || !std::isfinite(result)) {
            fail(value, fmt::format("expected a finite number of metres, got {}", value.description()));
        }
        return result;
    }

    Vec3 point(const Value& value) const {
        if (list(value, "a list of three numbers").items.size() != 3) {
            fail(value, fmt::format("expected three numbers, got {}", value.items.size()));
        }
        return {number(value.items[0]), number(value.items[1]), number(value.items[2])};
    }

    /// Reads `[x, y, z, r]`, `{center, radius}` or `{origin, radius}`.
    Sphere sphere(const Value& value) const {
        if (value.is(Kind::list)) {
            if (value.items.size() != 4) {
                fail(value, fmt::format("expected a sphere [x, y, z, radius], got a list of {}", value.items.size()));
            }
            return {{number(value.items[0]), number(value.items[1]), number(value.items[2])}, number(value.items[3])};
        }
        const Value* origin = value.is(Kind::map) ? value.find("origin") : nullptr;
        return {point(origin ? *origin : at(value, "center")), number(at(value, "radius"))};
    }

    void add(const std::string& link, const Value& spheres) {
        std::vector<Sphere>& target = spheres_of(result_, link);
        if (spheres.is(Kind::null)) {
            return;
        }
        for (const Value& value : list(spheres, fmt::format("a list of spheres for link '{}'", link)).items) {
            target.push_back(sphere(value));
        }
    }

    /// Reads `{centers: [[x, y, z]], radii: [r]}`.
    void columns(const Value& value, const std::string& link) {
        const Value& centers = list(at(value, "centers"), "a list of centers");
        const Value& radii = list(at(value, "radii"), "a list of radii");
        if (centers.items.size() != radii.items.size()) {
            fail(value, fmt::format("{} centers and {} radii{}", centers.items.size(), radii.items.size(),
                                    link.empty() ? "" : fmt::format(" for link '{}'", link)));
        }
        std::vector<Sphere>& target = spheres_of(result_, link);
        for (std::size_t i = 0; i < radii.items.size(); ++i) {
            target.push_back({point(centers.items[i]), number(radii.items[i])});
        }
    }

    void foam_links(const Value& root) {
        result_.format = "foam JSON";
        if (const Value& version = at(root, "foam_spheres"); version.text != "1") {
            fail(version, fmt::format("foam_spheres is {}; this foam reads 1", version.description()));
        }
        for_each(at(root, "links"),
                 [&](const std::string& link, const Value& value) { add(link, at(value, "spheres")); });
    }

    void xrdf(const Value& root) {
        result_.format = "XRDF";
        const Value* collision = root.find("world_collision");
        collision = collision ? collision : &at(root, "collision");
        const std::string name = at(*collision, "geometry").text;
        note_buffer(*collision, "buffer_distance");
        for_each(at(at(at(root, "geometry"), name), "spheres"),
                 [&](const std::string& link, const Value& value) { add(link, value); });
    }

    /// Reads the forms of cuRobo and bubblify: a map of lists; plainmp: a map of maps; Lula: a list of such maps.
    void collision_spheres(const Value& spheres, const Value& holder, bool in_kinematics) {
        if (spheres.is(Kind::text)) {
            fail(spheres, fmt::format("the spheres are in another file, '{}'; remedy: give that one", spheres.text));
        }
        note_buffer(holder, "collision_sphere_buffer");
        result_.format = in_kinematics ? "cuRobo YAML" : "collision_spheres YAML";
        const auto add_link = [&](const std::string& link, const Value& value) {
            if (value.is(Kind::map)) {
                result_.format = "plainmp YAML";
                add(link, at(value, "spheres"));
            } else {
                add(link, value);
            }
        };
        if (spheres.is(Kind::list)) {
            result_.format = "Lula YAML";
            for (const Value& entry : spheres.items) {
                for_each(entry, add_link);
            }
            return;
        }
        for_each(spheres, add_link);
    }

    /// Notes a distance that a program adds to all radii. It is reported, not added.
    void note_buffer(const Value& holder, std::string_view key) {
        const Value* buffer = holder.is(Kind::map) ? holder.find(key) : nullptr;
        const auto zero = [](const Value& v) { return v.is_scalar() && v.whole == 0 && v.real == 0; };
        if (buffer && !zero(*buffer) &&
            !(buffer->is(Kind::map) && std::all_of(buffer->items.begin(), buffer->items.end(), zero))) {
            result_.notes.push_back(
                fmt::format("{} (line {}) is not added to the radii: the spheres are judged as they stand", key,
                            buffer->where.line));
        }
    }

    /// Reads one object per depth, the last the finest: the output of CoMMALab/foam for a single mesh.
    void original_list(const Value& root) {
        if (root.items.empty()) {
            unknown(root);
        }
        result_.format = "list of CoMMALab/foam";
        const Value& finest = root.items.back();
        const Value* link = finest.is(Kind::map) ? finest.find("link") : nullptr;
        add(link ? link->text : "", at(finest, "spheres"));
    }

    /// Reads columns by link (ballpark, pyroki), or the database of CoMMALab/foam, by "link::mesh", branch and depth.
    void map_of_links(const Value& root) {
        if (root.keys.empty()) {
            unknown(root);
        }
        const Value& first = root.items.front();
        if (first.is(Kind::map) && first.find("centers")) {
            result_.format = "centers and radii by link";
            for_each(root, [&](const std::string& link, const Value& value) { columns(value, link); });
            return;
        }
        if (root.keys.front().text.find("::") == std::string::npos) {
            unknown(root);
        }
        result_.format = "database of CoMMALab/foam";
        for_each(root, [&](const std::string& key, const Value& branches) {
            const Value& depths = largest_key(branches, "branch");
            add(key.substr(0, key.rfind("::")), at(largest_key(depths, "depth"), "spheres"));
        });
    }

    /// Returns the value of the largest key; all keys are numbers.
    const Value& largest_key(const Value& map, std::string_view what) const {
        const Value* best = nullptr;
        long largest = -1;
        for_each(map, [&](const std::string& key, const Value& value) {
            long n = -1;
            const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), n);
            if (error != std::errc{} || end != key.data() + key.size()) {
                fail(value, fmt::format("'{}' is not a {}", key, what));
            }
            if (n > largest) {
                largest = n;
                best = &value;
            }
        });
        if (!best) {
            fail(map, fmt::format("there is no {}", what));
        }
        return *best;
    }

    SphereFile& result_;
};

} // namespace

void read_tree(const std::string& text, SphereFile& result) {
    reading::Findings findings(result.file.string());
    std::optional<Value> root;
    if (reading::check_text(text, 0, findings, sphere_file)) {
        root = reading::read_yaml(text, 0, findings, sphere_file);
    }
    if (findings.any_error() || !root) {
        const std::vector<Diagnostic> all = findings.take();
        throw Error(ErrorCode::input, fmt::format("{}: {}", all.front().where.text(), all.front().message));
    }
    TreeReader(result).read(*root);
}

} // namespace foam::judge::model_formats
