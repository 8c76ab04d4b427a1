#include "newer.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element.hpp>
#include <foam/xml/document.hpp>

#include <cmath>
#include <numbers>

namespace foam::load_sdf {

Mesh cone_mesh(double radius, double length) {
    constexpr int sides = 48;
    const double wider = radius / std::cos(std::numbers::pi / sides); // its sides touch the circle
    std::vector<Vec3> corners{{0, 0, length / 2}};
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        corners.push_back({wider * std::cos(angle), wider * std::sin(angle), -length / 2});
    }
    return convex_hull(corners)->surface;
}

struct Optimizations::Text {
    /// Collects the meshes that are hulls, by line, with their URIs.
    void add(const xml::Element& element, std::string_view text) {
        const std::string* stated = element.name == "mesh" ? element.attribute("optimization") : nullptr;
        const xml::Element* uri = stated && *stated == "convex_hull" ? element.child("uri") : nullptr;
        if (uri && !uri->self_closing()) {
            const auto parts = words(text.substr(uri->start_tag.end, uri->end_tag - uri->start_tag.end));
            hulls.emplace(element.line, parts.size() == 1 ? parts.front() : "");
        }
        for (const auto& child : element.children) {
            add(*child, text);
        }
    }

    std::multimap<int, std::string> hulls;
};

const Optimizations::Text& Optimizations::text_of(const Place& place, const Document& document) {
    auto& text = texts_[place.file];
    if (!text) {
        auto made = std::make_shared<Text>();
        constexpr std::uintmax_t most = 100'000'000;
        const std::string content = place.file == document.file()
                                        ? main_text_
                                        : read_regular_file(place.file, most, "a smaller file").bytes;
        if (content.find("convex_hull") != content.npos) {
            made->add(*xml::parse(content, place.file.string(), ErrorCode::input), content);
        }
        text = std::move(made);
    }
    return *text;
}

bool Optimizations::is_hull(const ::sdf::Mesh& mesh, const Document& document) {
    if (!mesh.Element()) {
        return false;
    }
    const Place place = document.place_of(mesh.Element());
    const auto [begin, end] = text_of(place, document).hulls.equal_range(place.line);
    for (auto it = begin; it != end; ++it) {
        if (it->second.empty() || it->second == mesh.Uri()) {
            return true;
        }
    }
    return false;
}

} // namespace foam::load_sdf
