#include <foam/yaml/findings.hpp>

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::yaml {

std::string Location::text() const {
    return line > 0 ? fmt::format("{}:{}:{}", file, line, column) : file;
}

std::string Diagnostic::text() const {
    return fmt::format("{}: {}[{}]: {}", where.text(), level == Level::error ? "error" : "warning", code, message);
}

namespace {

constexpr std::size_t most_findings = 500;

} // namespace

Findings::Findings(std::string file) {
    add_file(std::move(file), {});
}

int Findings::add_file(std::string file, std::filesystem::path folder) {
    sources_.push_back({std::move(file), std::move(folder), 0});
    return static_cast<int>(sources_.size()) - 1;
}

int Findings::add_argument(std::string option, int n) {
    sources_.push_back({std::move(option), {}, n});
    return static_cast<int>(sources_.size()) - 1;
}

const std::filesystem::path& Findings::folder_of(const Place& place) const {
    return sources_.at(static_cast<std::size_t>(place.source)).folder;
}

void Findings::error(const Place& place, std::string code, std::string message) {
    any_error_ = true;
    add(Diagnostic::Level::error, place, std::move(code), std::move(message));
}

void Findings::warning(const Place& place, std::string code, std::string message) {
    add(Diagnostic::Level::warning, place, std::move(code), std::move(message));
}

Location Findings::locate(const Place& place) const {
    const Source& source = sources_.at(static_cast<std::size_t>(place.source));
    return source.argument == 0 ? Location{source.file, place.line, place.column}
                                : Location{source.file, source.argument, 1};
}

void Findings::add(Diagnostic::Level level, const Place& place, std::string code, std::string message) {
    Key key{place.source, place.line, place.column, code, message};
    if (seen_.contains(key)) {
        return; // each point of a sweep is checked; common findings are reported once
    }
    if (list_.size() >= most_findings) {
        ++left_out_;
        return;
    }
    seen_.insert(key);
    list_.emplace_back(std::move(key), Diagnostic{level, locate(place), std::move(code), std::move(message)});
}

std::vector<Diagnostic> Findings::take() {
    std::stable_sort(list_.begin(), list_.end(), [](const auto& a, const auto& b) {
        const auto place = [](const Key& key) {
            return std::tuple(std::get<0>(key), std::get<1>(key), std::get<2>(key));
        };
        return place(a.first) < place(b.first);
    });
    std::vector<Diagnostic> result;
    for (auto& [key, diagnostic] : list_) {
        result.push_back(std::move(diagnostic));
    }
    if (left_out_ > 0) {
        Diagnostic rest;
        rest.where.file = sources_.front().file;
        rest.code = "too-many";
        rest.message = fmt::format("{} more findings; correct these first", left_out_);
        result.push_back(std::move(rest));
    }
    return result;
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t most = 60;
    std::size_t end = std::min(most, text.size());
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
        ++end; // not within a character
    }
    return fmt::format("'{}{}'", shown(text.substr(0, end)), end < text.size() ? "…" : "");
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
    if (const std::string near = word.size() < 200 ? nearest_word(word, known) : ""; !near.empty()) {
        return fmt::format("; did you mean {}?", in_quotes(near));
    }
    std::vector<std::string> names;
    std::transform(known.begin(), known.end(), std::back_inserter(names), shown);
    return !known.empty() && known.size() <= 40 ? fmt::format("; known: {}", fmt::join(names, ", ")) : "";
}

} // namespace foam::yaml
