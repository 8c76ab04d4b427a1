// YAML events of yaml-cpp -> Value. Events instead of YAML::Node: nodes do not keep the places of keys, they silently
// keep duplicate keys, and aliases make them cyclic.
#include <foam/yaml/value.hpp>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <sstream>
#include <unordered_map>

namespace foam::yaml {
namespace {

constexpr std::size_t deepest = 50;

/// Ends the reading early, after a finding.
struct Stop {};

/// Converts yaml-cpp's marks (0-based, columns in bytes) to places (1-based, columns in characters).
class PlaceFinder {
public:
    PlaceFinder(const std::string& text, int source) : text_(text), source_(source) {
        starts_.push_back(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (text[i] == '\n') {
                starts_.push_back(i + 1);
            }
        }
    }

    Place operator()(const YAML::Mark& mark) const {
        // Characters are counted only in lines of usual length.
        constexpr int longest = 1000;
        int column = mark.column + 1;
        if (mark.column <= longest && static_cast<std::size_t>(mark.line) < starts_.size()) {
            const std::string_view before = line(mark.line).substr(0, static_cast<std::size_t>(mark.column));
            for (const char c : before) {
                column -= (static_cast<unsigned char>(c) & 0xC0U) == 0x80U ? 1 : 0;
            }
        }
        return {source_, mark.line + 1, column};
    }

    /// Returns whether the quoted text at the mark is closed: yaml-cpp accepts the end of the file as its end.
    bool is_closed_quote(const YAML::Mark& mark) const {
        const std::size_t begin = offset(mark);
        const char quote = begin < text_.size() ? text_[begin] : ' ';
        if (quote != '"' && quote != '\'') {
            return true; // a block text, or after a tag
        }
        for (std::size_t i = begin + 1; i < text_.size(); ++i) {
            if (quote == '"' && text_[i] == '\\') {
                ++i;
            } else if (text_[i] == quote) {
                if (quote == '"' || i + 1 >= text_.size() || text_[i + 1] != quote) {
                    return true;
                }
                ++i; // '' within single quotes is one quote
            }
        }
        return false;
    }

    bool indented_by_tab(int index) const {
        const std::string_view text = line(index);
        const std::size_t tab = text.find('\t');
        return tab != std::string_view::npos && text.find_first_not_of(" \t") > tab;
    }

private:
    std::size_t offset(const YAML::Mark& mark) const {
        const std::size_t line_index = static_cast<std::size_t>(mark.line);
        return line_index < starts_.size() ? starts_[line_index] + static_cast<std::size_t>(mark.column) : text_.size();
    }

    std::string_view line(int index) const {
        const std::size_t i = static_cast<std::size_t>(index);
        if (index < 0 || i >= starts_.size()) {
            return {};
        }
        const std::size_t end = i + 1 < starts_.size() ? starts_[i + 1] : text_.size();
        return std::string_view(text_).substr(starts_[i], end - starts_[i]);
    }

    const std::string& text_;
    int source_;
    std::vector<std::size_t> starts_;
};

class TreeBuilder final : public YAML::EventHandler {
public:
    TreeBuilder(const PlaceFinder& place, std::size_t most_events, Findings& findings, std::string_view kind)
        : place_(place), events_left_(most_events), findings_(findings), kind_(kind) {}

    bool has_document() const { return documents_ > 0; }
    /// Returns whether the first document was read completely.
    bool complete() const { return documents_ > 1; }
    Value take() { return std::move(root_); }
    /// Returns the beginning of the innermost open list or map; nullptr if none is open.
    const Place* open_place() const { return frames_.empty() ? nullptr : &frames_.back().value.where; }

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (++documents_ > 1) {
            findings_.error(
                place_(mark), "second-document",
                fmt::format(
                    "a {0} is one YAML document, and it ended before this line; remedy: delete '---' and '...', "
                    "and write the {0} as one map whose keys start in the same column",
                    kind_));
            throw Stop{};
        }
    }
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark& mark, YAML::anchor_t) override {
        Value value;
        value.where = place_(mark);
        add(std::move(value));
    }
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
        refuse_alias(place_(mark));
        Value value;
        value.where = place_(mark);
        add(std::move(value), true);
    }
    void OnAnchor(const YAML::Mark& mark, const std::string& name) override {
        findings_.error(place_(mark), "alias",
                        fmt::format("anchors such as {} are not part of {}s; remedy: delete it and write the value out "
                                    "where it is needed",
                                    in_quotes("&" + name), kind_));
    }
    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, const std::string& text) override {
        const Place where = place_(mark);
        if (tag == "?") {
            add(plain_scalar(text, where));
            return;
        }
        check_tag(tag, where);
        if (!place_.is_closed_quote(mark)) {
            findings_.error(where, "syntax", "this quoted text is never closed; remedy: add the closing quote");
            throw Stop{};
        }
        Value value;
        value.kind = Value::Kind::text;
        value.where = where;
        value.text = text;
        value.quoted = true;
        add(std::move(value));
    }
    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                         YAML::EmitterStyle::value) override {
        open(Value::Kind::list, mark, tag);
    }
    void OnSequenceEnd() override { close(); }
    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                    YAML::EmitterStyle::value) override {
        open(Value::Kind::map, mark, tag);
    }
    void OnMapEnd() override { close(); }

    void refuse_alias(const Place& where) {
        findings_.error(
            where, "alias",
            fmt::format("aliases (*name) are not part of {}s; remedy: put a name that begins with * in quotes, as in "
                        "\"*finger\", and write shared values out",
                        kind_));
    }

private:
    struct Frame {
        Value value;
        bool has_key = false; ///< map: a key without its value yet
        bool drop = false;    ///< map: that value is left out, after a finding
        Key key;
        std::unordered_map<std::string, Place> seen;
    };

    void check_tag(const std::string& tag, const Place& where) {
        if (tag != "?" && tag != "!" && !tag.empty()) {
            constexpr std::string_view core = "tag:yaml.org,2002:";
            const std::string shown = tag.starts_with(core) ? "!!" + tag.substr(core.size()) : tag;
            findings_.error(
                where, "tag",
                fmt::format("tags such as {} are not part of {}s; remedy: delete it", in_quotes(shown), kind_));
        }
    }

    void open(Value::Kind kind, const YAML::Mark& mark, const std::string& tag) {
        Frame frame;
        frame.value.kind = kind;
        frame.value.where = place_(mark);
        check_tag(tag, frame.value.where);
        if (frames_.size() >= deepest) {
            findings_.error(
                frame.value.where, "too-deep",
                fmt::format("lists and maps are nested more than {} deep; no {} needs that", deepest, kind_));
            throw Stop{};
        }
        frames_.push_back(std::move(frame));
    }

    void close() {
        Value value = std::move(frames_.back().value);
        frames_.pop_back();
        add(std::move(value));
    }

    /// Adds a value. `refused`: there is a finding on the value already; no further one is added.
    void add(Value value, bool refused = false) {
        if (events_left_-- == 0) {
            findings_.error(value.where, "syntax", "the YAML parser cannot read this line; remedy: correct this line");
            throw Stop{};
        }
        if (frames_.empty()) {
            root_ = std::move(value);
            return;
        }
        Frame& frame = frames_.back();
        if (frame.value.is(Value::Kind::list)) {
            if (refused) {
                return;
            }
            frame.value.items.push_back(std::move(value));
        } else if (!frame.has_key) {
            frame.has_key = true;
            frame.drop = true;
            if (!refused) {
                take_key(frame, value);
            }
        } else {
            frame.has_key = false;
            if (!frame.drop && !refused) {
                frame.value.keys.push_back(std::move(frame.key));
                frame.value.items.push_back(std::move(value));
            }
        }
    }

    void take_key(Frame& frame, const Value& value) {
        frame.key = {value.text, value.where};
        if (!value.is_scalar() || value.is(Value::Kind::null)) {
            findings_.error(
                value.where, "wrong-type",
                fmt::format("a key must be a word, got {}; remedy: write 'key: value'", value.description()));
        } else if (value.text == "<<" && !value.quoted) {
            findings_.error(value.where, "merge-key",
                            fmt::format("the merge key '<<' is not part of {}s; remedy: write the keys out", kind_));
        } else if (const auto [first, fresh] = frame.seen.emplace(value.text, value.where); !fresh) {
            findings_.error(value.where, "duplicate-key",
                            fmt::format("key {} is given twice, first in line {}; remedy: delete one",
                                        in_quotes(value.text), first->second.line));
        } else {
            frame.drop = false;
        }
    }

    const PlaceFinder& place_;
    std::size_t events_left_;
    Findings& findings_;
    std::string_view kind_;
    int documents_ = 0;
    Value root_;
    std::vector<Frame> frames_;
};

/// Returns yaml-cpp's message in words for authors of recipes.
std::string explain(const std::string& message) {
    static constexpr std::pair<std::string_view, std::string_view> table[] = {
        {"illegal map value",
         "a ': ' that does not belong here; remedy: check the indentation of this line and the one "
         "above, and put a text that holds ': ' in quotes"},
        {"end of map not found", "this line is no 'key: value' of the map above it; remedy: check its indentation"},
        {"end of sequence not found", "this line is no '- item' of the list above it; remedy: check its indentation"},
        {"end of map flow not found", "this '{' is never closed, or a ',' is missing in it; remedy: complete it"},
        {"end of sequence flow not found", "this '[' is never closed, or a ',' is missing in it; remedy: complete it"},
        {"illegal EOF in scalar", "a quoted text is never closed; remedy: add the closing quote"},
        {"illegal block entry", "a '- ' that does not belong here; remedy: begin the list in a line of its own"},
        {"illegal flow end", "a ']' or '}' that closes nothing; remedy: delete it"},
        {"unknown token", "no YAML value begins with this character; remedy: put the text in quotes"},
    };
    for (const auto& [theirs, ours] : table) {
        if (message == theirs) {
            return std::string(ours);
        }
    }
    return fmt::format("{}; remedy: correct the YAML here", message);
}

void report(const YAML::Exception& error, const PlaceFinder& place, TreeBuilder& builder, Findings& findings) {
    const bool nowhere = error.mark.is_null();
    const bool at_end = error.mark.line == 0 && error.mark.column == 0 && error.mark.pos == 0;
    if (error.msg.starts_with("the referenced anchor is not defined")) { // yaml-cpp 0.8 adds its name
        builder.refuse_alias(place(error.mark));
    } else if (!nowhere && place.indented_by_tab(error.mark.line)) {
        findings.error(place(error.mark), "syntax", "a tab in the indentation; remedy: indent with spaces");
    } else if ((nowhere || at_end || error.msg.find("flow not found") != std::string::npos) && builder.open_place()) {
        findings.error(*builder.open_place(), "syntax", explain(error.msg));
    } else {
        findings.error(nowhere ? Place{} : place(error.mark), "syntax", explain(error.msg));
    }
}

} // namespace

std::optional<Value> read_yaml(const std::string& text, int source, Findings& findings, const TextKind& kind) {
    const PlaceFinder place(text, source);
    // Every event takes a character, except empty keys and values in "{,,,}": more events than that are an endless
    // loop.
    TreeBuilder builder(place, 4 * text.size() + 16, findings, kind.name);
    std::istringstream stream(text);
    try {
        YAML::Parser parser(stream);
        while (parser.HandleNextDocument(builder)) {
        }
    } catch (const Stop&) {
        return builder.complete() ? std::optional(builder.take()) : std::nullopt;
    } catch (const YAML::Exception& error) {
        report(error, place, builder, findings);
        return std::nullopt;
    }
    return builder.has_document() ? std::optional(builder.take()) : Value{};
}

Value tree_of(const std::string& text, const std::string& file, const TextKind& kind, ErrorCode code) {
    Findings findings(file);
    std::optional<Value> root;
    if (check_text(text, 0, findings, kind)) {
        root = read_yaml(text, 0, findings, kind);
    }
    if (findings.any_error() || !root) {
        const std::vector<Diagnostic> all = findings.take();
        throw Error(code, all.empty() ? file + ": the file is empty"
                                      : fmt::format("{}: {}", all.front().where.text(), all.front().message));
    }
    return std::move(*root);
}

} // namespace foam::yaml
