#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/judge/collision_model.hpp>
#include <foam/xml/document.hpp>
#include <foam/yaml/value.hpp>

#include <fmt/format.h>

#include <map>
#include <utility>

namespace foam::inline judge {
namespace {

/// Reasons by pair; the first reason counts.
using Pairs = std::map<std::pair<std::string, std::string>, std::string>;

void add(Pairs& pairs, const std::string& a, const std::string& b, const std::string& reason) {
    pairs.emplace(std::minmax(a, b), reason);
}

/// Adds the pairs of all <disable_collisions> of an SRDF.
void add_disabled(const xml::Element& element, const std::string& file, Pairs& pairs) {
    if (element.name == "disable_collisions") {
        const std::string* a = element.attribute("link1");
        const std::string* b = element.attribute("link2");
        if (!a || !b || a->empty() || b->empty()) {
            throw Error(ErrorCode::input, fmt::format("{}:{}: <disable_collisions> does not name two links; remedy: "
                                                      "<disable_collisions link1=\"A\" link2=\"B\"/>",
                                                      file, element.line));
        }
        const std::string* reason = element.attribute("reason");
        add(pairs, *a, *b, reason ? *reason : "");
    }
    for (const auto& child : element.children) {
        add_disabled(*child, file, pairs);
    }
}

Pairs read_srdf(const std::string& text, const std::string& file) {
    Pairs pairs;
    add_disabled(*xml::parse(text, file, ErrorCode::input), file, pairs);
    return pairs;
}

using yaml::Value;

const Value* child(const Value* map, std::string_view key) {
    return map && map->is(Value::Kind::map) ? map->find(key) : nullptr;
}

/// Reads `{link: [link, …]}`.
Pairs pairs_of(const Value& ignore, const std::string& file) {
    Pairs pairs;
    const auto expect = [&](const Value& value, Value::Kind kind, const char* what) {
        if (!value.is(kind)) {
            throw Error(ErrorCode::input, fmt::format("{}:{}:{}: expected {}, got {}", file, value.where.line,
                                                      value.where.column, what, value.description()));
        }
    };
    expect(ignore, Value::Kind::map, "a map of links");
    for (std::size_t i = 0; i < ignore.keys.size(); ++i) {
        if (ignore.items[i].is(Value::Kind::null)) {
            continue;
        }
        expect(ignore.items[i], Value::Kind::list, "a list of links");
        for (const Value& other : ignore.items[i].items) {
            expect(other, Value::Kind::text, "the name of a link");
            add(pairs, ignore.keys[i].text, other.text, "");
        }
    }
    return pairs;
}

Pairs read_yaml_ignores(const std::string& text, const std::string& file) {
    constexpr yaml::TextKind kind{.name = "robot file", .most_bytes = 64'000'000};
    const Value root = yaml::tree_of(text, file, kind);
    const Value* robot = child(&root, "robot_cfg");
    const Value* kinematics = child(robot ? robot : &root, "kinematics");
    const Value* ignore = child(kinematics ? kinematics : &root, "self_collision_ignore");
    ignore = ignore ? ignore : child(child(&root, "self_collision"), "ignore");
    if (!ignore) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: it excludes no pairs of links; supported are the <disable_collisions> of SRDFs, "
                                "cuRobo's self_collision_ignore and XRDF's self_collision",
                                file));
    }
    return pairs_of(*ignore, file);
}

} // namespace

std::vector<IgnoredPair> read_ignored_pairs(const std::filesystem::path& file) {
    const std::string text = read_file(file, most_robot_bytes);
    const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    const bool is_xml = begin != text.npos && text[begin] == '<';
    std::vector<IgnoredPair> result;
    for (auto& [links, reason] : is_xml ? read_srdf(text, file.string()) : read_yaml_ignores(text, file.string())) {
        result.push_back({links.first, links.second, reason});
    }
    return result;
}

} // namespace foam::judge
