// A file in memory, errors with their place, and the reading of words and numbers from text.
#pragma once

#include <foam/base/error.hpp>
#include <foam/geometry/vector.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace foam::load_mesh {

struct Source {
    std::filesystem::path file;
    std::string bytes;

    /// Returns Error(input) "FILE: what" or "FILE:LINE: what".
    Error error(std::string_view what) const;
    Error error_at(std::size_t line, std::string_view what) const;
    /// Returns the line, 1-based, of a byte. O(offset).
    std::size_t line_of(std::size_t offset) const;
};

/// Returns the word for a message: cut to a readable length, unprintable characters replaced.
std::string printable(std::string_view word);
/// Returns the text with a '?' for each byte that is not UTF-8: exporters write names in any encoding.
std::string with_valid_utf8(std::string_view text);
std::string text_of(const Vec3& point);

/// Returns a number in C notation, whatever the locale. "inf" and "nan" are numbers. Too small numbers become 0. Empty
/// if it is not a number or too large for a double.
std::optional<double> to_number(std::string_view word);
std::optional<std::int64_t> to_integer(std::string_view word);

/// Words separated by white space, with their lines.
class Words {
public:
    /// Reads the bytes [begin, end). `comment`: the character that begins a comment to the end of the line; 0: there
    /// are no comments.
    Words(const Source& source, std::size_t begin, std::size_t end, std::size_t first_line, char comment);

    /// Returns the next word; empty at the end.
    std::string_view next();
    /// Returns the line of the last word, 1-based.
    std::size_t line() const { return line_; }
    void skip_line();
    std::size_t bytes_left() const { return text_.size() - at_; }

    /// Returns the next word as a number or integer. Throws an error with what was expected.
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

/// Lines without comments; words are taken from the front.
class Lines {
public:
    Lines(const Source& source, char comment, bool backslash_continues);

    /// Moves to the next line. Returns false at the end of the file.
    bool next();
    std::size_t line() const { return line_; }
    /// Returns the next word of the line; empty if there is none.
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
