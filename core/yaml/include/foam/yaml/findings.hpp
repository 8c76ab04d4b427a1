// The findings in a text, each with its place.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace foam {
namespace [[gnu::visibility("default")]] yaml {

/// A place in a text; 1-based. Line 0: the whole file.
struct Location {
    std::string file;
    int line = 0, column = 0;
    std::string text() const; ///< "file:line:column"
};

/// A finding in a text.
struct Diagnostic {
    enum class Level { warning, error };
    Level level = Level::error;
    Location where;
    std::string code; ///< stable word: "unknown-key", "wrong-type", "out-of-bounds", …
    std::string message;
    std::string text() const; ///< "file:line:column: error[code]: message"
};

/// A place in one of several texts that belong together. Source 0: the file; others: see Findings.
struct Place {
    int source = 0, line = 0, column = 0;
};

class Findings {
public:
    explicit Findings(std::string file);

    /// Adds a text: a file, and its folder relative to that of the recipe. Returns its number for Place::source.
    int add_file(std::string file, std::filesystem::path folder);
    /// Adds a text: the n-th value of an option on the command line, "--set". Returns its number for Place::source.
    int add_argument(std::string option, int n);
    /// Returns the folder of a place's file, relative to the recipe's; empty: the same.
    const std::filesystem::path& folder_of(const Place& place) const;

    void error(const Place& place, std::string code, std::string message);
    void warning(const Place& place, std::string code, std::string message);
    bool any_error() const { return any_error_; }
    Location locate(const Place& place) const;
    /// Returns the findings in the order of the text, each once. After a few hundred the rest is only counted.
    std::vector<Diagnostic> take();

private:
    void add(Diagnostic::Level level, const Place& place, std::string code, std::string message);

    using Key = std::tuple<int, int, int, std::string, std::string>; // source, line, column, code, message
    struct Source {
        std::string file;
        std::filesystem::path folder;
        int argument; ///< 0: a file
    };
    std::vector<Source> sources_;
    std::set<Key> seen_;
    std::vector<std::pair<Key, Diagnostic>> list_;
    std::size_t left_out_ = 0;
    bool any_error_ = false;
};

/// Returns `text` in single quotes for a message: shortened, control characters escaped.
std::string in_quotes(std::string_view text);
/// Returns "; did you mean 'x'?" for the nearest of `known`; else the list of `known`, or nothing if that is too long.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

} // namespace yaml
} // namespace foam
