#include "text.hpp"

#include <foam/base/cancellation.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace foam::load_mesh {
namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

template <class T> std::optional<T> parsed(std::string_view word, std::errc& problem) {
    if (word.size() > 1 && word.front() == '+' && word[1] != '-') {
        word.remove_prefix(1);
    }
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    problem = error;
    if (word.empty() || end != word.data() + word.size() || error == std::errc::invalid_argument) {
        problem = std::errc::invalid_argument;
        return std::nullopt;
    }
    return value;
}

/// Returns whether a number outside the range of double is too small rather than too large.
bool is_tiny(std::string_view number) {
    const std::size_t exponent = number.find_first_of("eE");
    if (exponent != number.npos) {
        return number.substr(exponent + 1).starts_with('-');
    }
    return number.find_first_of("123456789") > number.find('.');
}

std::string_view first_word(std::string_view& text) {
    std::size_t begin = 0;
    while (begin < text.size() && is_space(text[begin])) {
        ++begin;
    }
    std::size_t end = begin;
    while (end < text.size() && !is_space(text[end])) {
        ++end;
    }
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

/// Returns how many bytes at the front are one UTF-8 character; 0: none.
std::size_t utf8_length(std::string_view text) {
    const auto byte = static_cast<unsigned char>(text[0]);
    const std::size_t length = byte < 0x80   ? 1
                               : byte < 0xC2 ? 0
                               : byte < 0xE0 ? 2
                               : byte < 0xF0 ? 3
                               : byte < 0xF5 ? 4
                                             : 0;
    for (std::size_t i = 1; i < length; ++i) {
        if (i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) {
            return 0;
        }
    }
    return length;
}

double number_or_throw(const Source& source, std::size_t line, std::string_view word, std::string_view what) {
    if (const auto value = to_number(word)) {
        return *value;
    }
    throw source.error_at(line, word.empty() ? fmt::format("{} is missing", what)
                                             : fmt::format("{} is to be a number, got {}", what, printable(word)));
}

} // namespace

Error Source::error(std::string_view what) const {
    return {ErrorCode::input, fmt::format("{}: {}", file.string(), what)};
}

Error Source::error_at(std::size_t line, std::string_view what) const {
    return {ErrorCode::input, fmt::format("{}:{}: {}", file.string(), line, what)};
}

std::size_t Source::line_of(std::size_t offset) const {
    return 1 + static_cast<std::size_t>(
                   std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

std::string printable(std::string_view word) {
    constexpr std::size_t longest = 40;
    std::string text(word.substr(0, longest));
    for (char& c : text) {
        if (c < ' ' || c > '~') {
            c = '?';
        }
    }
    return fmt::format("'{}{}'", text, word.size() > longest ? "..." : "");
}

std::string with_valid_utf8(std::string_view text) {
    std::string result(text);
    CancellationCounter asking(8192);
    for (std::size_t at = 0; at < text.size();) {
        asking.check();
        const std::size_t length = utf8_length(text.substr(at));
        if (length == 0) {
            result[at] = '?';
        }
        at += std::max<std::size_t>(length, 1);
    }
    return result;
}

std::string text_of(const Vec3& point) {
    const auto unsigned_nan = [](double value) { return std::isnan(value) ? std::abs(value) : value; };
    return fmt::format("({}, {}, {})", unsigned_nan(point.x), unsigned_nan(point.y), unsigned_nan(point.z));
}

std::optional<double> to_number(std::string_view word) {
    std::errc problem{};
    const auto value = parsed<double>(word, problem);
    if (problem == std::errc::result_out_of_range) {
        return is_tiny(word) ? std::optional(0.0) : std::nullopt;
    }
    return value;
}

std::optional<std::int64_t> to_integer(std::string_view word) {
    std::errc problem{};
    const auto value = parsed<std::int64_t>(word, problem);
    return problem == std::errc() ? value : std::nullopt;
}

Words::Words(const Source& source, std::size_t begin, std::size_t end, std::size_t first_line, char comment)
    : source_(source), text_(std::string_view(source.bytes).substr(0, end)), at_(begin), line_(first_line),
      comment_(comment) {}

void Words::skip_space() {
    for (; at_ < text_.size(); ++at_) {
        const char c = text_[at_];
        if (c == '\n') {
            ++line_;
        } else if (comment_ && c == comment_) {
            while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') {
                ++at_;
            }
        } else if (!is_space(c)) {
            return;
        }
    }
}

std::string_view Words::next() {
    skip_space();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) {
        ++at_;
    }
    return text_.substr(begin, at_ - begin);
}

void Words::skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') {
        ++at_;
    }
}

double Words::number(std::string_view what) {
    const std::string_view word = next();
    return number_or_throw(source_, line_, word, what);
}

std::int64_t Words::integer(std::string_view what) {
    const std::string_view word = next();
    if (const auto value = to_integer(word)) {
        return *value;
    }
    throw source_.error_at(line_, word.empty() ? fmt::format("{} is missing: the file ends here", what)
                                               : fmt::format("{} is to be an integer, got {}", what, printable(word)));
}

Lines::Lines(const Source& source, char comment, bool backslash_continues)
    : source_(source), rest_(source.bytes), comment_(comment), backslash_continues_(backslash_continues) {}

std::string_view Lines::take_line() {
    const auto end = std::find_if(rest_.begin(), rest_.end(), [](char c) { return c == '\n' || c == '\r'; });
    const auto length = static_cast<std::size_t>(end - rest_.begin());
    std::string_view text = rest_.substr(0, length);
    rest_.remove_prefix(length);
    if (rest_.starts_with("\r\n")) {
        rest_.remove_prefix(2);
    } else if (!rest_.empty()) {
        rest_.remove_prefix(1);
    }
    ++taken_;
    return text.substr(0, text.find(comment_));
}

bool Lines::next() {
    if (rest_.empty()) {
        return false;
    }
    current_ = take_line();
    line_ = taken_;
    if (backslash_continues_ && current_.ends_with('\\')) {
        joined_.clear();
        while (current_.ends_with('\\') && !rest_.empty()) {
            joined_.append(current_.substr(0, current_.size() - 1)).push_back(' ');
            current_ = take_line();
        }
        joined_.append(current_);
        current_ = joined_;
    }
    return true;
}

std::string_view Lines::word() {
    return first_word(current_);
}

double Lines::number(std::string_view what) {
    return number_or_throw(source_, line_, word(), what);
}

Vec3 Lines::point(std::string_view what) {
    Vec3 p;
    p.x = number(what);
    p.y = number(what);
    p.z = number(what);
    return p;
}

} // namespace foam::load_mesh
