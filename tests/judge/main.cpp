// judge ORIGINAL SPHERES [outer|inner] [--without LINK]...: judges a written sphere model by code that shares
// nothing with foam. ORIGINAL: a URDF, or a mesh as STL, OBJ or COLLADA; SPHERES: a URDF or CSV. Exit codes: 0 no
// objection, 1 an objection, with link, point and distance, 2 not readable.
#include "judge.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <set>
#include <stdexcept>

namespace {

using namespace judge;

struct Arguments {
    std::string original, spheres;
    bool inner = false;
    std::set<std::string> without;
};

Arguments read_arguments(int count, char** words) {
    Arguments arguments;
    if (count < 3) {
        throw std::runtime_error("usage: judge ORIGINAL SPHERES [outer|inner] [--without LINK]...");
    }
    arguments.original = words[1];
    arguments.spheres = words[2];
    for (int i = 3; i < count; ++i) {
        const std::string word = words[i];
        if (word == "--without" && i + 1 < count) {
            arguments.without.insert(words[++i]);
        } else if (word == "inner" || word == "outer") {
            arguments.inner = word == "inner";
        } else {
            throw std::runtime_error("unknown argument " + word);
        }
    }
    return arguments;
}

const std::vector<Ball>& spheres_of(const Link& link, const std::map<std::string, std::vector<Ball>>& spheres) {
    static const std::vector<Ball> none;
    if (link.name.empty() && spheres.size() == 1) {
        return spheres.begin()->second;
    }
    const auto found = spheres.find(link.name);
    return found == spheres.end() ? none : found->second;
}

bool object(const Link& link, const std::vector<Ball>& balls, bool inner) {
    if (balls.empty() && !inner) {
        std::printf("link '%s': it has no spheres\n", link.name.c_str());
        return true;
    }
    const auto objection = inner ? outside_of_solid(link, balls) : outside_of_balls(link, balls);
    if (objection) {
        const Point& p = objection->point;
        std::printf("link '%s': the point [%.17Lg, %.17Lg, %.17Lg] of %s lies outside %s by %.6Lg m\n",
                    link.name.c_str(), p.x, p.y, p.z, inner ? "a sphere" : "the geometry",
                    inner ? "the geometry" : "all spheres", objection->distance);
    }
    return objection.has_value();
}

int judge_files(const Arguments& arguments) {
    const std::vector<Link> links = read_original(arguments.original);
    const auto spheres = read_spheres(arguments.spheres, arguments.without);
    std::size_t judged = 0, objections = 0, balls = 0;
    for (const Link& link : links) {
        if (!arguments.without.contains(link.name)) {
            const std::vector<Ball>& of_link = spheres_of(link, spheres);
            balls += of_link.size();
            objections += object(link, of_link, arguments.inner) ? 1 : 0;
            ++judged;
        }
    }
    std::printf("%zu links, %zu spheres, %zu objections (%s)\n", judged, balls, objections,
                arguments.inner ? "inner" : "outer");
    if (judged == 0 || balls == 0) {
        throw std::runtime_error("nothing was judged");
    }
    return objections == 0 ? 0 : 1;
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
