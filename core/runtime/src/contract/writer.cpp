#include "promises.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/kinds.hpp>

#include <algorithm>
#include <numeric>

namespace foam::inline runtime {
namespace {

/// Returns a model of two joined links with a box each; the numbers of the second link's spheres need all digits.
SphereModel model() {
    auto robot = std::make_shared<Robot>();
    robot->name = "pair";
    robot->root = "base";
    robot->file = "pair.urdf";
    for (const char* name : {"base", "tool"}) {
        GeometryElement box;
        box.geometry = Element::box({1, 1, 1});
        robot->links.push_back({.name = name, .collisions = {box}, .visuals = {}});
    }
    Joint joint;
    joint.name = "wrist";
    joint.kind = Joint::Kind::revolute;
    joint.parent = "base";
    joint.child = "tool";
    joint.lower = -1;
    joint.upper = 2;
    robot->joints.push_back(joint);

    SphereModel model;
    model.name = "contract";
    model.groups.push_back({"base", {"box"}, flat_tree({{{0, 0, 0}, 0.9}}), {}});
    model.groups.push_back(
        {"tool", {"box"}, flat_tree({{{0.1, -0.2, 1.0 / 3}, 0.05}, {{1e-17, 1234.5, -0.0}, 0.1 + 0.7}}), {}});
    model.robot = std::move(robot);
    model.facts.tool_frames = {"tool"};
    model.ignored_pairs = {{"base", "tool", "Adjacent"}};
    return model;
}

/// Returns the model, or only its second link if the writer refuses two: some formats hold one body.
SphereModel model_for(const Writer& writer) {
    SphereModel two_links = model(), one_link = model();
    one_link.groups.erase(one_link.groups.begin());
    QuietContext context;
    try {
        writer.write(two_links, context);
    } catch (const Error& error) {
        const std::string message = error.what();
        require(error.code() == ErrorCode::output && message.find("remedy") != message.npos,
                fmt::format("it refuses a model of two links without a remedy: {}", message));
        return one_link;
    }
    return two_links;
}

void require_equal_up_to_growth(const std::string& link, const std::vector<Sphere>& read,
                                const std::vector<Sphere>& written) {
    require(read.size() == written.size(),
            fmt::format("link {}: {} spheres are read back, {} were written", link, read.size(), written.size()));
    for (std::size_t i = 0; i < read.size(); ++i) {
        const double moved = distance(read[i].center, written[i].center);
        require(
            read[i].radius >= written[i].radius + moved || (moved == 0 && read[i].radius == written[i].radius),
            fmt::format("link {}: sphere {} comes back smaller or elsewhere (radius {} for {}, moved by {} m); remedy: "
                        "write all digits (number_text), or round radii up",
                        link, i, read[i].radius, written[i].radius, moved));
    }
}

/// Returns an element of a kind at a pose that needs all digits.
Element element_of_kind(Element::Kind kind) {
    Element element;
    element.kind = kind;
    element.pose = Pose::from_xyz_rpy({0.1, -0.2, 1.0 / 3}, {0.3, -0.7, 2.1});
    switch (kind) {
    case Element::Kind::sphere:
        break;
    case Element::Kind::capsule:
    case Element::Kind::cylinder:
        element.half.z = 0.25;
        break;
    case Element::Kind::box:
    case Element::Kind::ellipsoid:
        element.half = {0.3, 0.2, 0.1};
        return element;
    case Element::Kind::swept_box:
        element.half = {0.3, 0.2, 0.1};
        break;
    case Element::Kind::hull:
        element.hull =
            convex_hull(std::vector<Vec3>{{0, 0, 0}, {0.5, 0, 0}, {0, 0.25, 0}, {0, 0, 0.125}, {0.5, 0.25, 0.5}});
        return element;
    }
    element.radius = 0.05;
    return element;
}

/// Returns a point well inside an element: that of a hull is the mean of its vertices.
Vec3 inner_point(const Element& element) {
    if (!element.hull) {
        return element.pose.translation;
    }
    const std::vector<Vec3>& vertices = element.hull->surface.vertices;
    return element.pose *
           (std::accumulate(vertices.begin(), vertices.end(), Vec3{}) * (1.0 / static_cast<double>(vertices.size())));
}

/// Requires that the elements that were read contain the one that was written.
void require_contained(const Element& written, const Elements& read) {
    require(read.size() > 0, fmt::format("{} is not read back", with_article(noun_of(written.kind, 1))));
    constexpr std::size_t directions = 200;
    constexpr double inwards = 1 - 1e-9; // orientations are read back to rounding
    const Vec3 middle = inner_point(written);
    for (const Vec3& direction : fibonacci_directions(directions)) {
        const Vec3 point = middle + (support(written, direction) - middle) * inwards;
        const bool held = std::any_of(read.begin(), read.end(), [&](const Element& e) { return holds(e, point); });
        require(held, fmt::format("{} comes back smaller or elsewhere; remedy: write all digits, or round outwards",
                                  with_article(noun_of(written.kind, 1))));
    }
}

/// Requires that an element of each kind that the writer's files hold is read back.
void check_kind(const Writer& writer, Element::Kind kind) {
    SphereModel elements = model_for(writer);
    const Element element = element_of_kind(kind);
    elements.groups.back().tree = flat_tree(std::vector<Element>{element});
    elements.file = "contract.urdf";
    QuietContext context;
    const std::string bytes = writer.write(elements, context);
    require(bytes == writer.write(elements, context), "the second time it writes other bytes");
    const auto beside = writer.files_beside(elements, context);
    const auto read = writer.read(bytes, beside);
    const auto found = read.find(elements.groups.back().link);
    require(found != read.end(), fmt::format("link {} is not read back", elements.groups.back().link));
    require_contained(element, found->second);
}

/// Checks the files that belong to the one of the writer.
void check_companions(const Writer& writer, const std::vector<std::string>& companions, Promises& promises) {
    if (companions.empty()) {
        return;
    }
    promises.check("writes the files that belong to it, the same bytes every time", [&] {
        QuietContext context;
        SphereModel spheres = model_for(writer);
        spheres.file = "contract.urdf";
        for (const std::string& ending : companions) {
            try {
                const std::string bytes = writer.companion(ending, spheres, context);
                require(bytes == writer.companion(ending, spheres, context),
                        fmt::format(".{}: the second time it writes other bytes", ending));
            } catch (const Error& error) { // of a stage that is not here, for one
                require(error.code() == ErrorCode::output,
                        fmt::format(".{}: it fails with the wrong code: {}; remedy: ErrorCode::output", ending,
                                    error.what()));
            }
        }
    });
}

} // namespace

void check_writer(const Writer& writer, const StageInfo& info, Promises& promises) {
    for (const Element::Kind kind : info.kinds) {
        if (kind != Element::Kind::sphere) {
            promises.check(fmt::format("gives back {}", with_article(noun_of(kind, 1))),
                           [&] { check_kind(writer, kind); });
        }
    }
    promises.check("gives back what it wrote, the same bytes every time", [&] {
        QuietContext context;
        const SphereModel spheres = model_for(writer);
        const std::string bytes = writer.write(spheres, context);
        require(bytes == writer.write(spheres, context), "the second time it writes other bytes");
        const auto read = writer.read(bytes, {});
        for (const SphereGroup& group : spheres.groups) {
            const auto found = read.find(group.link);
            require(found != read.end(), fmt::format("link {} is not read back", group.link));
            require(found->second.are_spheres(), fmt::format("link {}: its spheres come back as other kinds", group.link));
            require_equal_up_to_growth(group.link, found->second.spheres(), group.tree.finest());
        }
        require(read.size() == spheres.groups.size(),
                fmt::format("{} links are read back, {} were written", read.size(), spheres.groups.size()));
    });
    check_companions(writer, info.companions, promises);
    const auto require_refusal = [&](const std::string& what, const std::function<void()>& call) {
        try {
            call();
        } catch (const Error& error) {
            require(
                error.code() == ErrorCode::output,
                fmt::format("{}: it refuses with the wrong code: {}; remedy: ErrorCode::output", what, error.what()));
            return;
        }
        throw Breach(fmt::format("{} is not refused; remedy: throw Error(output)", what));
    };
    promises.check("refuses what nobody could read", [&] {
        require_refusal("a radius of nan", [&] {
            SphereModel spheres = model_for(writer);
            spheres.groups.back().tree.levels.back().elements.spheres()[0].radius = std::numeric_limits<double>::quiet_NaN();
            QuietContext context;
            writer.write(spheres, context);
        });
        require_refusal("reading bytes that are no such file", [&] { writer.read("\x7f nothing \x01", {}); });
    });
}

} // namespace foam::inline runtime
