// A file in memory, its errors with their place, and reading words and numbers from text.
#pragma once

#include <foam/error.hpp>
#include <foam/vector.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace foam::load_mesh {

struct Source {
    std::filesystem::path file;
    std::string bytes;

    /// Error(input) "FILE: what" or "FILE:LINE: what".
    Error error(std::string_view what) const;
    Error error_at(std::size_t line, std::string_view what) const;
    /// The line, 1-based, of a byte. O(offset).
    std::size_t line_of(std::size_t offset) const;
};

/// The word as it may stand in a message: cut to a readable length, unprintable characters replaced.
std::string printable(std::string_view word);
std::string lower(std::string_view text);
/// With a '?' for each byte that is no UTF-8: exporters write names of users and paths in whatever encoding.
std::string with_valid_utf8(std::string_view text);
std::string text_of(const Vec3& point);

/// A number in the C notation whatever the locale; "inf" and "nan" are numbers. Too small becomes 0; empty if it is
/// none or too large for a double.
std::optional<double> to_number(std::string_view word);
std::optional<std::int64_t> to_integer(std::string_view word);

/// Words separated by white space, with the line each stands on.
class Words {
public:
    /// The bytes [begin, end). `comment`: from this character to the end of a line is no text; 0: there are no
    /// comments.
    Words(const Source& source, std::size_t begin, std::size_t end, std::size_t first_line, char comment);

    /// The next word; empty at the end.
    std::string_view next();
    /// Line of the last word, 1-based.
    std::size_t line() const { return line_; }
    void skip_line();
    std::size_t bytes_left() const { return text_.size() - at_; }

    /// The next word as a number or integer; throws an error that says what it was to be.
    double number(std::string_view what);
    std::int64_t integer(std::string_view what);

private:
    void skip_space();

    const Source& source_;
    std::string_view text_;
    std::size_t at_;
    std::size_t line_;
    char comment_;
};

/// Lines with comments cut off; words are taken from the front.
class Lines {
public:
    Lines(const Source& source, char comment, bool backslash_continues);

    /// False at the end of the file.
    bool next();
    std::size_t line() const { return line_; }
    /// The next word of the line; empty if there is none left.
    std::string_view word();
    double number(std::string_view what);
    Vec3 point(std::string_view what);
    std::size_t bytes_left() const { return rest_.size(); }

private:
    std::string_view take_line();

    const Source& source_;
    std::string_view rest_;
    std::string joined_;
    std::string_view current_;
    std::size_t line_ = 0, taken_ = 0;
    char comment_;
    bool backslash_continues_;
};

} // namespace foam::load_mesh
