#include "scene.hpp"

#include <foam/base/hypot.hpp>

#include <algorithm>
#include <cmath>

namespace foam::snapshot {
namespace {

/// Calls `visit` with each vertex and each sphere of a panel that can be drawn: its place and how far it reaches.
template <class Visit> void for_each_part(const Panel& panel, Visit visit) {
    for (const FigureMesh& item : panel.meshes) {
        if (!item.mesh) {
            continue;
        }
        for (const Vec3& vertex : item.mesh->vertices) {
            if (const Vec3 p = item.pose * vertex; drawable(p)) {
                visit(p, 0.0);
            }
        }
    }
    for (const Sphere& sphere : panel.spheres) {
        if (drawable(sphere)) {
            visit(sphere.center, sphere.radius);
        }
    }
}

Vec3 along_each_axis(double length) {
    return {length, length, length};
}

/// Returns the bounds of a panel's content along the camera's axes.
Box extent(const Panel& panel, const Camera& camera) {
    Box box;
    for_each_part(panel, [&](const Vec3& place, double reach) {
        box.add(camera(place) - along_each_axis(reach));
        box.add(camera(place) + along_each_axis(reach));
    });
    return box;
}

/// Returns the bounds along the camera's axes while the camera turns about a vertical axis through the panel's middle.
Box extent_all_around(const Panel& panel, const Camera& camera) {
    Box content;
    for_each_part(panel, [&](const Vec3& place, double reach) {
        content.add(place - along_each_axis(reach));
        content.add(place + along_each_axis(reach));
    });
    Box box;
    if (content.empty()) {
        return box;
    }
    const Vec3 middle = content.center(), seen = camera(middle);
    for_each_part(panel, [&](const Vec3& place, double reach) {
        const Vec3 from = place - middle;
        const double away = foam::hypot(from.x, from.y), tilted = std::abs(camera.towards.z) * away;
        const Vec3 most{away + reach, tilted + reach, away + std::abs(from.z) + reach};
        const Vec3 height{0, camera.up.z * from.z, 0};
        box.add(seen + height - most);
        box.add(seen + height + most);
    });
    return box;
}

std::vector<Box> extents(const Figure& figure, const Camera& camera, bool turntable) {
    std::vector<Box> boxes;
    Box all;
    Vec3 largest{};
    for (const Panel& panel : figure.panels) {
        boxes.push_back(turntable ? extent_all_around(panel, camera) : extent(panel, camera));
        all.add(boxes.back());
        const Vec3 size = boxes.back().size();
        largest = {std::max(largest.x, size.x), std::max(largest.y, size.y), std::max(largest.z, size.z)};
    }
    // Panels of the same object share one frame, so that details have the same place in each of them.
    const double tolerance = 1.3;
    const Vec3 size = all.size();
    const bool same = size.x <= tolerance * largest.x && size.y <= tolerance * largest.y;
    for (Box& box : boxes) {
        if (same && !box.empty()) {
            box = all;
        }
    }
    return boxes;
}

std::optional<RadiusRange> radius_range(const Figure& figure) {
    std::optional<RadiusRange> range;
    for (const Panel& panel : figure.panels) {
        for (const Sphere& sphere : panel.spheres) {
            if (!drawable(sphere)) {
                continue;
            }
            if (!range) {
                range = RadiusRange{sphere.radius, sphere.radius};
            }
            range->least = std::min(range->least, sphere.radius);
            range->most = std::max(range->most, sphere.radius);
        }
    }
    return range;
}

/// The arrangement of panels in an area.
struct Grid {
    int rows = 1, columns = 1;
    double scale = 0; ///< pixels per metre
};

/// Returns the number of rows with the largest content; fewer rows if the content is nearly as large.
Grid best_grid(int panels, const Rectangle& area, double gap, double caption, double wide, double high) {
    Grid best;
    for (int rows = 1; rows <= panels; ++rows) {
        const int columns = (panels + rows - 1) / rows;
        const double cell_width = area.width / columns - gap;
        const double cell_height = area.height / rows - gap - caption;
        if (cell_width < 1 || cell_height < 1) {
            continue;
        }
        const double scale = std::min(cell_width / wide, cell_height / high);
        if (scale > 1.1 * best.scale) {
            best = {rows, columns, scale};
        }
    }
    if (best.scale == 0) {
        best = {1, panels, 1 / std::max(wide, high)}; // a picture too small to show anything
    }
    return best;
}

} // namespace

bool drawable(const Vec3& point) {
    const double limit = 1e100; // beyond it, squares overflow
    return std::abs(point.x) < limit && std::abs(point.y) < limit && std::abs(point.z) < limit;
}

bool drawable(const Sphere& sphere) {
    return drawable(sphere.center) && sphere.radius > 0 && sphere.radius < 1e100;
}

Layout arrange(const Figure& figure, const Camera& camera, bool turntable) {
    Layout layout{.camera = camera, .cells = {}, .colour_bar = {}, .radii = {}};
    layout.width = figure.width;
    layout.height = figure.height;
    layout.unit = std::sqrt(figure.width / 1280.0 * (figure.height / 960.0));
    const double margin = 24 * layout.unit;
    layout.title_height = figure.title.empty() ? 0 : 56 * layout.unit;

    Rectangle area{margin, margin + layout.title_height, figure.width - 2 * margin,
                   figure.height - 2 * margin - layout.title_height};
    const auto radii = radius_range(figure);
    layout.radii = radii.value_or(RadiusRange{});
    if (radii && figure.colour_bar) {
        const double column = 128 * layout.unit;
        const double height = std::min(0.62 * area.height, 460 * layout.unit);
        area.width -= column;
        layout.colour_bar = Rectangle{area.left + area.width + 0.3 * column, area.top + (area.height - height) / 2,
                                      24 * layout.unit, height};
    }
    if (figure.panels.empty()) {
        return layout;
    }

    const std::vector<Box> boxes = extents(figure, camera, turntable);
    double wide = 0, high = 0;
    for (const Box& box : boxes) {
        wide = std::max(wide, box.size().x);
        high = std::max(high, box.size().y);
    }
    if (!(std::max(wide, high) > 1e-100)) {
        wide = high = 1; // nothing or a single point
    }
    const bool captions =
        std::any_of(figure.panels.begin(), figure.panels.end(), [](const Panel& p) { return !p.caption.empty(); });
    const double caption = captions ? 44 * layout.unit : 0;
    const double gap = figure.panels.size() > 1 ? 16 * layout.unit : 0;
    const int count = static_cast<int>(figure.panels.size());
    const Grid grid = best_grid(count, area, gap, caption, wide, high);
    layout.scale = grid.scale;

    const double cell_width = area.width / grid.columns;
    const double cell_height = area.height / grid.rows;
    const double view_height = std::min(high * grid.scale, std::max(1.0, cell_height - gap - caption));
    for (int i = 0; i < count; ++i) {
        const int row = i / grid.columns;
        const int in_row = std::min(grid.columns, count - row * grid.columns);
        const double indent = (grid.columns - in_row) * cell_width / 2; // the last row is centred
        const double left = area.left + indent + (i % grid.columns) * cell_width;
        const double top = area.top + row * cell_height + (cell_height - view_height - caption) / 2;
        Layout::Cell cell;
        cell.view = {left, top, cell_width, view_height};
        cell.middle = boxes[i].empty() ? Vec3{} : boxes[i].center();
        cell.caption_top = top + view_height + 10 * layout.unit;
        cell.caption_left = left + gap / 2;
        cell.caption_width = cell_width - gap;
        layout.cells.push_back(cell);
    }
    return layout;
}

} // namespace foam::snapshot
