#include <foam.h>

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/internal/activity.hpp>
#include <foam/geometry/solid_of_balls.hpp>
#include <foam/search/spherize.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace {

using foam::Error;
using foam::ErrorCode;
using Clock = std::chrono::steady_clock;

Error usage(const std::string& message) {
    return Error(ErrorCode::usage, message);
}

void check(const foam_options& options) {
    if (options.size != sizeof(foam_options)) {
        throw usage(fmt::format("options->size is {}, not {}; remedy: set .size = sizeof(foam_options), and compile "
                                "with the foam.h of this library, version " FOAM_VERSION,
                                options.size, sizeof(foam_options)));
    }
    if (options.effort < FOAM_NORMAL || options.effort > FOAM_BEST) {
        throw usage(fmt::format("options->effort is {}; remedy: FOAM_NORMAL, FOAM_FAST or FOAM_BEST", options.effort));
    }
    if (options.objective < FOAM_EXCESS || options.objective > FOAM_MEAN_PROTRUSION) {
        throw usage(fmt::format("options->objective is {}; remedy: FOAM_EXCESS, FOAM_PROTRUSION, FOAM_RADIUS or "
                                "FOAM_MEAN_PROTRUSION",
                                options.objective));
    }
    if (!(options.time_limit >= 0)) {
        throw usage(
            fmt::format("options->time_limit is {}; remedy: seconds above 0, or 0 for no limit", options.time_limit));
    }
    constexpr std::uint32_t most_threads = 4096;
    if (options.threads > most_threads) {
        throw usage(fmt::format("options->threads is {}; remedy: at most {}, or 0 for one per core", options.threads,
                                most_threads));
    }
    if (options.reserved != 0) {
        throw usage(fmt::format("options->reserved is {}; remedy: initialise the struct, all of it", options.reserved));
    }
}

void check_arrays(const double* vertices, std::size_t vertex_count, const std::uint32_t* triangles,
                  std::size_t triangle_count) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
    if (!vertices || !triangles) {
        throw usage(
            fmt::format("{} is NULL; remedy: an array of three numbers each", vertices ? "triangles" : "vertices"));
    }
    if (vertex_count > most || triangle_count > most) {
        throw usage(fmt::format("{} vertices and {} triangles; remedy: at most {} of each", vertex_count,
                                triangle_count, most));
    }
    if (triangle_count == 0) {
        throw Error(ErrorCode::geometry, "the mesh has no triangle; remedy: a mesh with a surface");
    }
}

foam::Mesh mesh_of(const double* vertices, std::size_t vertex_count, const std::uint32_t* triangles,
                   std::size_t triangle_count) {
    check_arrays(vertices, vertex_count, triangles, triangle_count);
    foam::Mesh mesh;
    mesh.triangles.resize(triangle_count);
    for (std::size_t t = 0; t < triangle_count; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            mesh.triangles[t][k] = triangles[3 * t + k];
            if (mesh.triangles[t][k] >= vertex_count) {
                throw Error(ErrorCode::geometry,
                            fmt::format("triangle {} has the corner {}, but there are {} vertices; remedy: indices "
                                        "from 0 to vertex_count - 1",
                                        t, mesh.triangles[t][k], vertex_count));
            }
        }
    }
    mesh.vertices.resize(vertex_count);
    for (std::size_t v = 0; v < vertex_count; ++v) {
        const double* const p = vertices + 3 * v;
        if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
            throw Error(ErrorCode::geometry,
                        fmt::format("vertex {} is ({}, {}, {}); remedy: finite coordinates", v, p[0], p[1], p[2]));
        }
        mesh.vertices[v] = {p[0], p[1], p[2]};
    }
    return mesh;
}

/// The caller's request to end the search or the call: its time limit and its callback, which its thread alone calls.
class Poll final : public foam::StopRequest {
public:
    explicit Poll(const foam_options& options) : options_(options) {}

    bool used() const { return options_.poll || options_.time_limit > 0; }
    /// Returns whether the search should end, with or without a result.
    bool finish() {
        look();
        ended_search_ = ended_search_ || finish_;
        return finish_ || cancel_;
    }
    bool asked() const override {
        look();
        return cancel_;
    }
    bool ended_search() const { return ended_search_; }
    /// Throws what went wrong in the callback.
    void check() const {
        if (error_) {
            std::rethrow_exception(error_);
        }
    }

private:
    void look() const {
        if (std::this_thread::get_id() != caller_ || cancel_) {
            return;
        }
        const auto now = Clock::now();
        if (options_.time_limit > 0 && std::chrono::duration<double>(now - start_).count() >= options_.time_limit) {
            finish_ = true;
        }
        if (!options_.poll || now < next_) {
            return;
        }
        try { // not from here: any loop may be above
            obey(options_.poll(options_.user));
        } catch (...) {
            error_ = std::current_exception();
            cancel_ = true;
        }
        next_ = Clock::now() + std::chrono::milliseconds(2);
    }
    void obey(int answer) const {
        if (answer == FOAM_FINISH) {
            finish_ = true;
        } else if (answer == FOAM_CANCEL) {
            cancel_ = true;
        } else if (answer != FOAM_CONTINUE) {
            throw usage(
                fmt::format("options->poll returned {}; remedy: FOAM_CONTINUE, FOAM_FINISH or FOAM_CANCEL", answer));
        }
    }

    const foam_options& options_;
    const std::thread::id caller_ = std::this_thread::get_id();
    const Clock::time_point start_ = Clock::now();
    mutable Clock::time_point next_ = start_;
    bool ended_search_ = false;
    mutable bool finish_ = false;              ///< of the calling thread
    mutable std::atomic<bool> cancel_ = false; ///< which all threads read
    mutable std::exception_ptr error_;
};

foam::Effort effort_of(const foam_options& options) {
    return options.effort == FOAM_FAST   ? foam::Effort::fast
           : options.effort == FOAM_BEST ? foam::Effort::best
                                         : foam::Effort::normal;
}

foam::Objective objective_of(const foam_options& options) {
    return options.objective == FOAM_PROTRUSION        ? foam::Objective::protrusion
           : options.objective == FOAM_RADIUS          ? foam::Objective::radius
           : options.objective == FOAM_MEAN_PROTRUSION ? foam::Objective::mean_protrusion
                                                       : foam::Objective::excess;
}

using SolidMaker = std::function<std::shared_ptr<const foam::Solid>()>;

/// Returns the cover of a solid; it is made and covered on the threads and until the time that the options allow.
foam::Cover search(const SolidMaker& solid, std::size_t count, std::vector<foam::Element::Kind> kinds,
                   const foam_options& options, Poll& poll) {
    foam::CoverOptions settings{.kinds = std::move(kinds),
                                .effort = effort_of(options),
                                .objective = objective_of(options),
                                .seed = options.seed};
    foam::Cover cover;
    foam::on_threads(options.threads, [&] {
        std::optional<foam::StopScope> scope;
        if (poll.used()) {
            settings.stop = [&] { return poll.finish(); };
            scope.emplace(&poll);
        }
        cover = foam::cover(*solid(), count, settings);
    });
    return cover;
}

foam_options defaults() {
    foam_options options{};
    options.size = sizeof(foam_options);
    return options;
}

/// Checks the options and the count, searches, and reports.
foam::Cover covered(const SolidMaker& solid, std::size_t count, std::vector<foam::Element::Kind> kinds,
                    const foam_options* given, foam_report& report) {
    const foam_options options = given ? *given : defaults();
    check(options);
    if (count == 0 || count > FOAM_MAX_SPHERES) {
        throw usage(fmt::format("count is {}; remedy: 1 to {} {}", count, FOAM_MAX_SPHERES,
                                kinds == std::vector{foam::Element::Kind::sphere} ? "spheres" : "elements"));
    }
    Poll poll(options);
    foam::Cover cover;
    try {
        cover = search(solid, count, std::move(kinds), options, poll);
    } catch (...) {
        poll.check();
        throw;
    }
    poll.check();
    report.spheres = cover.elements.size();
    report.volume = cover.volume;
    report.certified = cover.certificate.holds ? 1 : 0;
    report.finished_early = poll.ended_search() ? 1 : 0;
    return cover;
}

/// Returns the kinds of a sum of theirs.
std::vector<foam::Element::Kind> kinds_in(unsigned sum) {
    std::vector<foam::Element::Kind> kinds;
    for (const foam::Element::Kind kind : foam::every_kind()) {
        if ((sum >> static_cast<unsigned>(kind) & 1U) != 0) {
            kinds.push_back(kind);
        }
    }
    if (kinds.empty() || sum >> foam::element_kinds != 0) {
        throw usage(fmt::format("kinds is {}; remedy: the sum of some of FOAM_SPHERE, FOAM_CAPSULE, …", sum));
    }
    return kinds;
}

int status_of(ErrorCode code) {
    switch (code) {
    case ErrorCode::usage:
        return FOAM_USAGE;
    case ErrorCode::input:
    case ErrorCode::geometry:
        return FOAM_GEOMETRY;
    case ErrorCode::cancelled:
        return FOAM_CANCELLED;
    default:
        return FOAM_INTERNAL;
    }
}

/// Writes a text that a caller can print: one line, cut between characters.
void tell(foam_report& report, std::string_view text) noexcept {
    std::size_t length = std::min(text.size(), sizeof report.error - 1);
    while (length < text.size() && length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0) == 0x80) {
        --length;
    }
    std::copy_n(text.data(), length, report.error);
    std::replace(report.error, report.error + length, '\n', ' ');
    report.error[length] = 0;
}

/// Describes the exception that is being handled in the report, and returns its code.
int describe_failure(foam_report& report) noexcept {
    try {
        throw;
    } catch (const Error& error) {
        tell(report, error.what());
        return status_of(error.code());
    } catch (const std::bad_alloc&) {
        tell(report, "there is not enough memory; remedy: fewer triangles or elements");
        return FOAM_MEMORY;
    } catch (const std::exception& error) {
        tell(report, error.what());
    } catch (...) {
        tell(report, "an exception of an unknown type; remedy: let no exception leave options->poll");
    }
    return FOAM_INTERNAL;
}

} // namespace

struct foam_region {
    std::shared_ptr<const foam::Solid> solid;
};

struct foam_elements {
    std::vector<foam::Element> all;
    std::vector<std::vector<double>> vertices; ///< of each, for hulls
};

namespace {

/// Calls body(), and reports what it throws.
template <class Body> int reported(foam_report* report, Body body) noexcept {
    if (!report || report->size != sizeof(foam_report)) {
        return FOAM_USAGE; // there is no place for a text
    }
    *report = foam_report{};
    report->size = sizeof(foam_report);
    try {
        body();
        return FOAM_OK;
    } catch (...) {
        return describe_failure(*report);
    }
}

template <class Handle> void require_place(Handle** place, const char* name) {
    if (!place) {
        throw usage(fmt::format("{} is NULL; remedy: the address of a pointer", name));
    }
    *place = nullptr;
}

std::vector<foam::Sphere> balls_of(const double* points, const double* radii, std::size_t count) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
    if (count > most) {
        throw usage(fmt::format("count is {}; remedy: at most {} points", count, most));
    }
    if (!points && count > 0) {
        throw usage("points is NULL; remedy: an array of three numbers each");
    }
    std::vector<foam::Sphere> balls;
    balls.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        balls.push_back({{points[3 * i], points[3 * i + 1], points[3 * i + 2]}, radii ? radii[i] : 0});
    }
    return balls;
}

void keep(const foam::Elements& found, foam_elements& kept) {
    for (const foam::Element& element : found) {
        std::vector<double>& corners = kept.vertices.emplace_back();
        if (element.hull) {
            for (const foam::Vec3& p : element.hull->surface.vertices) {
                corners.insert(corners.end(), {p.x, p.y, p.z});
            }
        }
        kept.all.push_back(element);
    }
}

} // namespace

extern "C" {

int foam_spherize(const double* vertices, size_t vertex_count, const uint32_t* triangles, size_t triangle_count,
                  size_t count, const foam_options* options, double* spheres, foam_report* report) {
    return reported(report, [&] {
        if (!spheres) {
            throw usage("spheres is NULL; remedy: an array of 4 * count numbers");
        }
        const auto solid = [&] {
            return foam::Solid::make(mesh_of(vertices, vertex_count, triangles, triangle_count));
        };
        const foam::Cover cover = covered(solid, count, {foam::Element::Kind::sphere}, options, *report);
        for (const foam::Sphere& sphere : cover.elements.spheres()) {
            const double row[] = {sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius};
            spheres = std::copy(std::begin(row), std::end(row), spheres);
        }
    });
}

int foam_region_of_mesh(const double* vertices, size_t vertex_count, const uint32_t* triangles, size_t triangle_count,
                        foam_region** region, foam_report* report) {
    return reported(report, [&] {
        require_place(region, "region");
        auto made = std::make_unique<foam_region>();
        made->solid = foam::Solid::make(mesh_of(vertices, vertex_count, triangles, triangle_count));
        *region = made.release();
    });
}

int foam_region_of_points(const double* points, const double* radii, size_t count, foam_region** region,
                          foam_report* report) {
    return reported(report, [&] {
        require_place(region, "region");
        auto made = std::make_unique<foam_region>();
        made->solid = foam::solid_of_balls(balls_of(points, radii, count));
        *region = made.release();
    });
}

void foam_region_free(foam_region* region) {
    delete region;
}

int foam_cover(const foam_region* region, size_t count, unsigned kinds, const foam_options* options,
               foam_elements** elements, foam_report* report) {
    return reported(report, [&] {
        require_place(elements, "elements");
        if (!region) {
            throw usage("region is NULL; remedy: one of foam_region_of_mesh() or foam_region_of_points()");
        }
        auto made = std::make_unique<foam_elements>();
        keep(covered([&] { return region->solid; }, count, kinds_in(kinds), options, *report).elements, *made);
        *elements = made.release();
    });
}

size_t foam_elements_count(const foam_elements* elements) {
    return elements ? elements->all.size() : 0;
}

int foam_elements_get(const foam_elements* elements, size_t index, foam_element* element) {
    if (!element || index >= foam_elements_count(elements)) {
        return FOAM_USAGE;
    }
    const foam::Element& e = elements->all[index];
    const std::vector<double>& vertices = elements->vertices[index];
    *element = {};
    element->kind = 1 << static_cast<int>(e.kind);
    element->radius = e.radius;
    element->vertex_count = vertices.size() / 3;
    element->vertices = vertices.empty() ? nullptr : vertices.data();
    for (int axis = 0; axis < 3; ++axis) {
        element->position[axis] = e.pose.translation[axis];
        element->half[axis] = e.half[axis];
        for (int column = 0; column < 3; ++column) {
            element->rotation[3 * axis + column] = e.pose.rotation[static_cast<std::size_t>(axis)][column];
        }
    }
    return FOAM_OK;
}

void foam_elements_free(foam_elements* elements) {
    delete elements;
}

const char* foam_version(void) {
    return FOAM_VERSION;
}
}
