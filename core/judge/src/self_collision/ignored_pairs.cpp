#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/judge/ignored_pairs.hpp>
#include <foam/yaml/value.hpp>

#include <expat.h>
#include <fmt/format.h>

#include <limits>
#include <map>
#include <utility>

namespace foam::inline judge {
namespace {

/// Reasons by pair; the first reason counts.
using Pairs = std::map<std::pair<std::string, std::string>, std::string>;

void add(Pairs& pairs, const std::string& a, const std::string& b, const std::string& reason) {
    pairs.emplace(std::minmax(a, b), reason);
}

/// Reads an SRDF. Exceptions must not pass through expat's C frames: the first error is kept and thrown afterwards.
class SrdfReader {
public:
    explicit SrdfReader(std::string file) : file_(std::move(file)), parser_(XML_ParserCreate(nullptr)) {
        XML_SetUserData(parser_, this);
        XML_SetStartElementHandler(parser_, [](void* self, const XML_Char* name, const XML_Char** attributes) {
            static_cast<SrdfReader*>(self)->start(name, attributes);
        });
    }
    ~SrdfReader() { XML_ParserFree(parser_); }
    SrdfReader(const SrdfReader&) = delete;
    SrdfReader& operator=(const SrdfReader&) = delete;

    Pairs read(const std::string& text) {
        if (text.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
            throw Error(ErrorCode::input, fmt::format("{}: the file is too large for an SRDF", file_));
        }
        if (XML_Parse(parser_, text.data(), static_cast<int>(text.size()), 1) != XML_STATUS_OK) {
            complain(fmt::format("no XML: {}", XML_ErrorString(XML_GetErrorCode(parser_))));
        }
        if (!complaint_.empty()) {
            throw Error(ErrorCode::input, complaint_);
        }
        return std::move(pairs_);
    }

private:
    void start(std::string_view name, const XML_Char** attributes) {
        if (name != "disable_collisions") {
            return;
        }
        std::map<std::string_view, std::string> values;
        for (; *attributes; attributes += 2) {
            values[attributes[0]] = attributes[1];
        }
        if (values["link1"].empty() || values["link2"].empty()) {
            complain("<disable_collisions> does not name two links; remedy: <disable_collisions link1=\"A\" "
                     "link2=\"B\"/>");
            return;
        }
        add(pairs_, values["link1"], values["link2"], values["reason"]);
    }

    void complain(const std::string& what) {
        if (complaint_.empty()) {
            complaint_ = fmt::format("{}:{}: {}", file_, XML_GetCurrentLineNumber(parser_), what);
        }
    }

    std::string file_;
    XML_Parser parser_;
    Pairs pairs_;
    std::string complaint_;
};

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
    yaml::Findings findings(file);
    std::optional<Value> root;
    if (yaml::check_text(text, 0, findings, kind)) {
        root = yaml::read_yaml(text, 0, findings, kind);
    }
    if (findings.any_error() || !root) {
        const std::vector<yaml::Diagnostic> all = findings.take();
        throw Error(ErrorCode::input, fmt::format("{}: {}", all.front().where.text(), all.front().message));
    }
    const Value* robot = child(&*root, "robot_cfg");
    const Value* kinematics = child(robot ? robot : &*root, "kinematics");
    const Value* ignore = child(kinematics ? kinematics : &*root, "self_collision_ignore");
    ignore = ignore ? ignore : child(child(&*root, "self_collision"), "ignore");
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
    const bool xml = begin != text.npos && text[begin] == '<';
    std::vector<IgnoredPair> result;
    for (auto& [links, reason] : xml ? SrdfReader(file.string()).read(text) : read_yaml_ignores(text, file.string())) {
        result.push_back({links.first, links.second, reason});
    }
    return result;
}

} // namespace foam::judge
