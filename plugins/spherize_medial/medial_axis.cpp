#include "stock.hpp"

#include <foam/base/cancellation.hpp>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>

#include <algorithm>
#include <queue>

namespace foam::medial {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_3<Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<std::size_t, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Point = Kernel::Point_3;

constexpr std::size_t first_points = 40; ///< of the surface, before the diagram is adapted
constexpr double enclosing_cube = 4;     ///< half edge; the shape's is 1/2
constexpr double negligible = 1e-6;      ///< protrusion, in units of the shape's extent

Point point(const Vec3& p) {
    return {p.x, p.y, p.z};
}

/// Finds the nearest of many points by comparing all: with a few thousand points that is faster than any tree.
class NearestPoint {
public:
    explicit NearestPoint(const std::vector<Vec3>& points) {
        for (const Vec3& p : points) {
            x_.push_back(p.x);
            y_.push_back(p.y);
            z_.push_back(p.z);
        }
        squares_.resize(points.size());
    }

    std::size_t operator()(const Vec3& p) {
        for (std::size_t i = 0; i < x_.size(); ++i) {
            const double dx = x_[i] - p.x, dy = y_[i] - p.y, dz = z_[i] - p.z;
            squares_[i] = dx * dx + dy * dy + dz * dz;
        }
        return static_cast<std::size_t>(std::min_element(squares_.begin(), squares_.end()) - squares_.begin());
    }

private:
    std::vector<double> x_, y_, z_, squares_;
};

bool touches(const Sphere& sphere, std::span<const Vec3> points) {
    return std::any_of(points.begin(), points.end(),
                       [&](const Vec3& p) { return distance(p, sphere.center) <= sphere.radius + negligible; });
}

} // namespace

struct MedialAxis::Diagram {
    struct Medial {
        Sphere sphere;
        double protrusion;   ///< radius less the distance to the surface
        std::size_t nearest; ///< surface point below it
        bool alive;
    };
    struct Entry {
        double protrusion;
        std::size_t medial;
        bool operator<(const Entry& other) const {
            return protrusion != other.protrusion ? protrusion < other.protrusion : medial > other.medial;
        }
    };
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    Diagram(std::vector<Vec3> points, std::function<bool(const Sphere&)> is_inside)
        : surface(std::move(points)), used(surface.size(), false), nearest(surface), inside(std::move(is_inside)) {
        for (int corner = 0; corner < 8; ++corner) {
            const auto side = [&](int bit) { return (corner & bit) != 0 ? enclosing_cube : -enclosing_cube; };
            delaunay.insert(Point(side(1), side(2), side(4)));
        }
        for (const auto cell : delaunay.all_cell_handles()) {
            cell->info() = none;
        }
        insert_spread(first_points);
    }

    /// Inserts points one by one, each the farthest from all before (Gonzalez 1985).
    void insert_spread(std::size_t count) {
        std::vector<double> reach(surface.size(), std::numeric_limits<double>::infinity());
        std::size_t next = 0;
        for (std::size_t n = 0; n < std::min(count, surface.size()); ++n) {
            insert(next);
            for (std::size_t i = 0; i < surface.size(); ++i) {
                reach[i] = std::min(reach[i], squared_norm(surface[i] - surface[next]));
            }
            next = static_cast<std::size_t>(std::max_element(reach.begin(), reach.end()) - reach.begin());
            if (!(reach[next] > 0)) {
                break;
            }
        }
    }

    /// Inserts a point. Only the cells in conflict with it change: their spheres are replaced by those of the new
    /// cells.
    void insert(std::size_t index) {
        check_cancelled();
        used[index] = true;
        const Point p = point(surface[index]);
        Delaunay::Locate_type type;
        int i = 0, j = 0;
        const auto located = delaunay.locate(p, type, i, j);
        if (type == Delaunay::VERTEX) {
            return;
        }
        std::vector<Delaunay::Cell_handle> conflicts;
        Delaunay::Facet facet;
        delaunay.find_conflicts(p, located, CGAL::Oneset_iterator<Delaunay::Facet>(facet),
                                std::back_inserter(conflicts));
        for (const auto cell : conflicts) {
            if (cell->info() != none) {
                medials[cell->info()].alive = false;
                --alive;
            }
        }
        const auto vertex = delaunay.insert_in_hole(p, conflicts.begin(), conflicts.end(), facet.first, facet.second);
        std::vector<Delaunay::Cell_handle> cells;
        delaunay.incident_cells(vertex, std::back_inserter(cells));
        for (const auto cell : cells) {
            enter(cell, index);
        }
    }

    /// Returns whether the cell has no volume within rounding: CGAL divides by it to find the center, and asserts that
    /// it can.
    static bool is_flat(const Delaunay::Cell& cell) {
        const auto edge = [&](int i) { return cell.vertex(i)->point() - cell.vertex(0)->point(); };
        return CGAL::determinant(edge(1), edge(2), edge(3)) == 0;
    }

    void enter(Delaunay::Cell_handle cell, std::size_t index) {
        cell->info() = none;
        if (delaunay.is_infinite(cell)) {
            return;
        }
        if (is_flat(*cell)) {
            return;
        }
        const Point c = delaunay.dual(cell);
        const Vec3 center{c.x(), c.y(), c.z()};
        const Sphere sphere{center, distance(center, surface[index])};
        if (!is_finite(center) || sphere.radius > 1 || !inside(sphere)) {
            return;
        }
        const std::size_t below = nearest(center);
        cell->info() = medials.size();
        medials.push_back({sphere, sphere.radius - distance(center, surface[below]), below, true});
        queue.push({medials.back().protrusion, medials.size() - 1});
        ++alive;
    }

    /// Adds the point below the sphere that protrudes most. Returns false if none protrudes.
    bool adapt() {
        while (!queue.empty()) {
            const Entry worst = queue.top();
            queue.pop();
            const Medial& medial = medials[worst.medial];
            if (!medial.alive) {
                continue;
            }
            if (worst.protrusion < negligible || used[medial.nearest]) {
                return false;
            }
            insert(medial.nearest);
            return true;
        }
        return false;
    }

    bool holds(const Vec3& p) const {
        for (const Medial& m : medials) {
            if (m.alive && distance(p, m.sphere.center) <= m.sphere.radius + negligible) {
                return true;
            }
        }
        return false;
    }

    /// Adds the surface points next to uncovered points. Returns false if there was none to add.
    bool cover_more(std::span<const Vec3> cover, std::size_t limit) {
        bool added = false;
        for (const Vec3& p : cover) {
            if (alive >= limit) {
                break;
            }
            if (holds(p)) {
                continue;
            }
            const std::size_t next = nearest(p);
            if (!used[next]) {
                insert(next);
                added = true;
            }
        }
        return added;
    }

    std::vector<Vec3> surface;
    std::vector<bool> used;
    NearestPoint nearest;
    std::function<bool(const Sphere&)> inside;
    Delaunay delaunay;
    std::vector<Medial> medials;
    std::priority_queue<Entry> queue;
    std::size_t alive = 0; ///< number of medial spheres
};

MedialAxis::MedialAxis(std::vector<Vec3> surface, std::function<bool(const Sphere&)> inside)
    : diagram_(std::make_unique<Diagram>(std::move(surface), std::move(inside))) {}
MedialAxis::~MedialAxis() = default;

void MedialAxis::take_all(Context& context) {
    for (std::size_t i = 0; i < diagram_->surface.size(); ++i) {
        if (!diagram_->used[i]) {
            context.check_cancelled();
            diagram_->insert(i);
        }
    }
}

void MedialAxis::refine(std::size_t count, std::span<const Vec3> cover, Context& context) {
    // Three quarters for the spheres that protrude, the rest for points in no sphere.
    const std::size_t adaptive = count - count / 4;
    while (diagram_->alive < adaptive && diagram_->adapt()) {
        context.check_cancelled();
    }
    while (diagram_->alive < count && diagram_->cover_more(cover, count)) {
        context.check_cancelled();
    }
}

void MedialAxis::refine_region(std::size_t count, double error_factor, std::span<const Vec3> cover, Context& context) {
    Diagram& d = *diagram_;
    double first_error = -1;
    std::vector<bool> touching; // by medial sphere: one never moves, and new ones are appended
    for (;;) {
        context.check_cancelled();
        for (std::size_t i = touching.size(); i < d.medials.size(); ++i) {
            touching.push_back(d.medials[i].alive && touches(d.medials[i].sphere, cover));
        }
        std::size_t found = 0, worst = Diagram::none;
        for (std::size_t i = 0; i < d.medials.size(); ++i) {
            if (d.medials[i].alive && touching[i]) {
                ++found;
                if (!d.used[d.medials[i].nearest] &&
                    (worst == Diagram::none || d.medials[i].protrusion > d.medials[worst].protrusion)) {
                    worst = i;
                }
            }
        }
        if (worst == Diagram::none) {
            d.cover_more(cover, d.alive + count);
            return;
        }
        const double error = d.medials[worst].protrusion;
        first_error = first_error < 0 ? error : first_error;
        if (error < negligible || (found >= count && error <= first_error / error_factor)) {
            return;
        }
        d.insert(d.medials[worst].nearest);
    }
}

std::vector<Sphere> MedialAxis::spheres() const {
    std::vector<Sphere> result;
    for (const auto& m : diagram_->medials) {
        if (m.alive) {
            result.push_back(m.sphere);
        }
    }
    return result;
}

std::vector<Sphere> MedialAxis::touching(std::span<const Vec3> points) const {
    std::vector<Sphere> result = spheres();
    std::erase_if(result, [&](const Sphere& sphere) { return !touches(sphere, points); });
    return result;
}

} // namespace foam::medial
