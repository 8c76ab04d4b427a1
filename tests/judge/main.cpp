// judge ORIGINAL MODEL [outer|inner] [--without LINK]... [--volume N] [--solid N]: judges a written model by code that shares
// nothing with foam. ORIGINAL: a URDF, or a mesh as STL, OBJ or COLLADA; MODEL: a URDF with the meshes of its hulls,
// JSON, or CSV. --volume: prints the share of each link's solid that lies outside all elements, of about N points.
// --solid: objects to such points of links whose meshes have an inside beyond doubt.
// Exit codes: 0 no objection, 1 an objection, with link, point and distance, 2 not readable.
#include "judge.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <set>
#include <stdexcept>

namespace {

using namespace judge;

struct Arguments {
    std::string original, model;
    bool inner = false;
    std::set<std::string> without;
    std::size_t volume_points = 0, solid_points = 0; ///< 0: not asked for
};

Arguments read_arguments(int count, char** words) {
    Arguments arguments;
    if (count < 3) {
        throw std::runtime_error("usage: judge ORIGINAL MODEL [outer|inner] [--without LINK]... [--volume N] [--solid N]");
    }
    arguments.original = words[1];
    arguments.model = words[2];
    for (int i = 3; i < count; ++i) {
        const std::string word = words[i];
        if (word == "--without" && i + 1 < count) {
            arguments.without.insert(words[++i]);
        } else if (word == "--volume" && i + 1 < count) {
            arguments.volume_points = std::stoul(words[++i]);
        } else if (word == "--solid" && i + 1 < count) {
            arguments.solid_points = std::stoul(words[++i]);
        } else if (word == "inner" || word == "outer") {
            arguments.inner = word == "inner";
        } else {
            throw std::runtime_error("unknown argument " + word);
        }
    }
    return arguments;
}

/// Those of the link; those of the only link for a mesh, which has no name.
template <typename Kind>
const std::vector<Kind>& of_link(const Link& link, const std::map<std::string, std::vector<Kind>>& by_link) {
    static const std::vector<Kind> none;
    if (link.name.empty() && by_link.size() == 1) {
        return by_link.begin()->second;
    }
    const auto found = by_link.find(link.name);
    return found == by_link.end() ? none : found->second;
}

void print(const Link& link, const Objection& objection, bool inner) {
    const Point& p = objection.point;
    std::printf("link '%s': the point [%.17Lg, %.17Lg, %.17Lg] of %s lies outside %s by %.6Lg m\n", link.name.c_str(),
                p.x, p.y, p.z, inner ? "a sphere" : "the geometry", inner ? "the geometry" : "all elements",
                objection.distance);
}

void print_volume(const Link& link, const std::vector<Body>& elements, std::size_t points) {
    if (const auto missing = missing_volume(link, elements, points)) {
        std::printf("link '%s': %.6Lg of its volume lies outside all elements\n", link.name.c_str(), missing->share);
    } else {
        std::printf("link '%s': no volume was found\n", link.name.c_str());
    }
}

struct Verdict {
    std::size_t links = 0, elements = 0, objections = 0, solids = 0;
};

void judge_outer(const Link& link, const std::vector<Body>& elements, const Arguments& arguments, Verdict& verdict) {
    verdict.elements += elements.size();
    if (elements.empty()) {
        std::printf("link '%s': it has no elements\n", link.name.c_str());
        ++verdict.objections;
        return;
    }
    if (const auto objection = outside_of_elements(link, elements)) {
        print(link, *objection, false);
        ++verdict.objections;
    }
    if (arguments.volume_points > 0) {
        print_volume(link, elements, arguments.volume_points);
    }
    if (arguments.solid_points > 0 && plain(link)) {
        ++verdict.solids;
        const auto missing = missing_volume(link, elements, arguments.solid_points);
        if (missing && missing->farthest) {
            print(link, *missing->farthest, false);
            ++verdict.objections;
        }
    }
}

void judge_inner(const Link& link, const std::vector<Ball>& balls, Verdict& verdict) {
    verdict.elements += balls.size();
    if (const auto objection = outside_of_solid(link, balls)) {
        print(link, *objection, true);
        ++verdict.objections;
    }
}

int judge_files(const Arguments& arguments) {
    const auto elements = read_elements(arguments.model, arguments.without);
    const auto balls =
        arguments.inner ? read_spheres(arguments.model, arguments.without) : std::map<std::string, std::vector<Ball>>{};
    Verdict verdict;
    for (const Link& link : read_original(arguments.original)) {
        if (arguments.without.contains(link.name)) {
            continue;
        }
        ++verdict.links;
        if (arguments.inner) {
            judge_inner(link, of_link(link, balls), verdict);
        } else {
            judge_outer(link, of_link(link, elements), arguments, verdict);
        }
    }
    std::printf("%zu links, %zu elements, %zu objections (%s)\n", verdict.links, verdict.elements, verdict.objections,
                arguments.inner ? "inner" : "outer");
    if (arguments.solid_points > 0) {
        std::printf("%zu of them as solids\n", verdict.solids);
    }
    if (verdict.links == 0 || verdict.elements == 0) {
        throw std::runtime_error("nothing was judged");
    }
    return verdict.objections == 0 ? 0 : 1;
}

} // namespace

int main(int count, char** words) {
    try {
        return judge_files(read_arguments(count, words));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "judge: %s\n", error.what());
        return 2;
    }
}
