// YAML or JSON text as a tree of values with their places.
#pragma once

#include <foam/base/error.hpp>
#include <foam/yaml/findings.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foam {
namespace [[gnu::visibility("default")]] yaml {

struct Key {
    std::string text;
    Place where;
};

struct Value {
    enum class Kind { null, boolean, integer, number, text, list, map };

    Kind kind = Kind::null;
    Place where;
    bool flag = false;        ///< boolean
    std::int64_t whole = 0;   ///< integer
    double real = 0;          ///< number; also an integer too large for `whole`
    std::string text;         ///< text; for other scalars as written
    bool quoted = false;      ///< text in quotes
    std::vector<Key> keys;    ///< map
    std::vector<Value> items; ///< list: the items; map: the value of each key

    bool is(Kind k) const { return kind == k; }
    bool is_scalar() const { return kind != Kind::list && kind != Kind::map; }
    /// Returns the value of a key of a map; nullptr if there is none.
    const Value* find(std::string_view key) const;
    const Key* find_key(std::string_view key) const;
    void erase(std::string_view key);
    /// Returns words for messages: "a list", "the text 'x'", "12".
    std::string description() const;
};

/// Returns a plain scalar according to the core schema of YAML 1.2 (section 10.3.2): 010 is ten, yes is text, 0x1F is
/// 31, 1_000 is text.
Value plain_scalar(std::string text, const Place& where);

/// The name of a kind of text in messages, and its largest size.
struct TextKind {
    std::string_view name = "recipe";
    std::size_t most_bytes = 1'000'000;
};

/// Reads one YAML document, or JSON, which is YAML. Refuses the features of YAML that are often misunderstood: anchors,
/// aliases, merge keys, tags, duplicate keys, further documents. Returns nothing if the text has no tree; errors are
/// findings in any case. `source`: see Place. Precondition: `text` has passed check_text().
std::optional<Value> read_yaml(const std::string& text, int source, Findings& findings, const TextKind& kind = {});

/// Returns the tree of a text by check_text() and read_yaml(). Throws Error(code) with `file`, line and column of the
/// first finding.
Value tree_of(const std::string& text, const std::string& file, const TextKind& kind,
              ErrorCode code = ErrorCode::input);

/// Checks size and encoding: UTF-8 without control characters. Returns false after a finding.
bool check_text(const std::string& text, int source, Findings& findings, const TextKind& kind = {});

} // namespace yaml
} // namespace foam
