#include "layer.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace foam::usd {
namespace {

constexpr std::string_view link_word = "{link}";

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

std::string replaced(std::string text, std::string_view word, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(word, at)) != text.npos; at += by.size()) {
        text.replace(at, word.size(), by);
    }
    return text;
}

} // namespace

bool is_identifier(std::string_view name) {
    return !name.empty() && !is_digit(name.front()) &&
           std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

std::string identifier(std::string_view name) {
    std::string result(name.empty() ? "_" : name);
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (!is_letter(result[i]) && (i == 0 || !is_digit(result[i]))) {
            result[i] = '_';
        }
    }
    return result;
}

std::map<std::string, std::string> prim_names(const std::vector<std::string>& links) {
    std::map<std::string, std::string> names;
    std::set<std::string> taken;
    for (const std::string& link : links) { // identifiers first: they must not yield to others
        if (is_identifier(link)) {
            names[link] = link;
            taken.insert(link);
        }
    }
    for (const std::string& link : links) {
        if (names.contains(link)) {
            continue;
        }
        std::string name = identifier(link);
        for (int number = 2; taken.contains(name); ++number) {
            name = identifier(link) + "_" + std::to_string(number);
        }
        taken.insert(name);
        names[link] = name;
    }
    return names;
}

PathPattern::PathPattern(const std::string& pattern, const std::string& robot, bool many_links) {
    const auto fail = [&](const std::string& why) {
        throw Error(
            ErrorCode::output,
            fmt::format("write.usd: prim: '{}' {}; remedy: such as /World/{{robot}}/{{link}}", shown(pattern), why));
    };
    if (!pattern.starts_with('/') || pattern.size() < 2) {
        fail("is no path of a prim from the root, '/'");
    }
    bool for_each_link = false;
    for (std::size_t begin = 1; begin <= pattern.size();) {
        const std::size_t end = std::min(pattern.find('/', begin), pattern.size());
        const std::string part = replaced(pattern.substr(begin, end - begin), "{robot}", identifier(robot));
        const bool of_link = part.find(link_word) != part.npos;
        if (!is_identifier(replaced(part, link_word, "link"))) {
            fail(fmt::format("has the part '{}'; names of prims have letters, digits and '_' only", shown(part)));
        }
        for_each_link = for_each_link || of_link;
        parts_.push_back(part);
        begin = end + 1;
    }
    if (!for_each_link && many_links) {
        fail("is the same for all links");
    }
}

std::string PathPattern::path(const std::string& prim_name) const {
    std::string path;
    for (const std::string& part : parts_) {
        path += '/' + replaced(part, link_word, prim_name);
    }
    return path;
}

} // namespace foam::usd
