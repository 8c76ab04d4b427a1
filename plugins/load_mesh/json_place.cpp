#include "json_place.hpp"

#include <fmt/format.h>

#include <cmath>

namespace foam::load_mesh {

Error JsonPlace::error(std::string_view what) const {
    return source_->error(
        fmt::format("{} {}; remedy: export or copy it again", path_.empty() ? "the JSON" : path_, what));
}

std::optional<JsonPlace> JsonPlace::find(std::string_view key) const {
    if (!value_->is_object()) {
        return std::nullopt;
    }
    const auto it = value_->find(key);
    if (it == value_->end()) {
        return std::nullopt;
    }
    JsonPlace result = *this;
    result.value_ = &*it;
    result.path_ = path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
    return result;
}

JsonPlace JsonPlace::at(std::string_view key) const {
    if (auto member = find(key)) {
        return *member;
    }
    throw error(fmt::format("has no '{}'", key));
}

JsonPlace JsonPlace::operator[](std::size_t index) const {
    JsonPlace result = *this;
    result.value_ = &(*value_)[index];
    result.path_ = fmt::format("{}[{}]", path_, index);
    return result;
}

JsonPlace JsonPlace::target(const JsonPlace& root, std::string_view key) const {
    const std::uint64_t index = natural();
    const auto list = root.find(key);
    const std::size_t count = list ? list->size() : 0;
    if (index >= count) {
        throw error(fmt::format("refers to {}[{}], but there are {}", key, index, count));
    }
    return (*list)[index];
}

std::uint64_t JsonPlace::natural() const {
    constexpr double largest = 0x1p48;
    if (value_->is_number()) { // some exporters write 12.0
        const double value = value_->get<double>();
        if (value >= 0 && value < largest && value == std::floor(value)) {
            return static_cast<std::uint64_t>(value);
        }
    }
    throw error("is to be a natural number");
}

double JsonPlace::number() const {
    if (!value_->is_number()) {
        throw error("is to be a number");
    }
    return value_->get<double>();
}

std::vector<double> JsonPlace::numbers(std::size_t count) const {
    if (size() != count) {
        throw error(fmt::format("is to be {} numbers", count));
    }
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i) {
        result.push_back((*this)[i].number());
    }
    return result;
}

bool JsonPlace::flag(std::string_view key) const {
    const auto member = find(key);
    return member && member->value_->is_boolean() && member->value_->get<bool>();
}

std::uint64_t JsonPlace::natural(std::string_view key, std::uint64_t otherwise) const {
    const auto member = find(key);
    return member ? member->natural() : otherwise;
}

} // namespace foam::load_mesh
