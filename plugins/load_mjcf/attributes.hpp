// The attributes of an element, with those of its default classes.
#pragma once

#include "document.hpp"

#include <foam/geometry/vector.hpp>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foam::mjcf {

/// What an element states itself, and what its class states for it.
class Attributes {
public:
    Attributes() = default;
    explicit Attributes(const Node& node) { take(node); }

    /// Adds the attributes of an element, which replace those so far.
    void take(const Node& node);
    /// Returns the text; nullptr if it is stated nowhere.
    const std::string* text(std::string_view key) const;
    /// Returns the text; `otherwise` if it is stated nowhere.
    std::string word(std::string_view key, std::string_view otherwise = {}) const;
    /// Returns the numbers; none if they are stated nowhere. Fails on anything else than `least` to `most` numbers.
    std::vector<double> numbers(std::string_view key, std::size_t least, std::size_t most) const;
    std::optional<double> number(std::string_view key) const;
    std::optional<Vec3> vector(std::string_view key) const;
    /// Returns whether it is "true". Fails on anything but "true", "false" and, where `automatic` is given, "auto".
    bool flag(std::string_view key, bool otherwise, std::optional<bool> automatic = {}) const;
    /// Throws Error(input) naming the place where an attribute is stated, else that of the element.
    [[noreturn]] void fail(std::string_view key, const std::string& what) const;

private:
    struct Stated {
        std::string text;
        const Node* by = nullptr;
    };
    std::map<std::string, Stated, std::less<>> stated_;
    const Node* node_ = nullptr;
};

/// The <default> classes of a model.
class Classes {
public:
    explicit Classes(const Node& root);

    /// Returns the attributes of an element: its own, over those of its class, of `childclass` or of the class of all.
    Attributes of(const Node& node, const std::string& childclass) const;
    /// Returns the class that is stated for what is below a body or frame; `inherited` if none is.
    std::string childclass_of(const Node& node, const std::string& inherited) const;

private:
    using Class = std::map<std::string, Attributes, std::less<>>; ///< by the name of the element

    void read(const Node& node, const Class* parent);
    const Class& known(const Node& node, const std::string& name) const;

    std::map<std::string, Class> classes_;
};

} // namespace foam::mjcf
