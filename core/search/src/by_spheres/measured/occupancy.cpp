#include "by_spheres/measured/occupancy.hpp"

#include <foam/base/parallel.hpp>

#include <algorithm>
#include <cmath>

namespace foam::inline search::by_spheres {
namespace {

/// Lines per cell, along each of the two directions across.
constexpr int lines_per_cell = 2;

/// Computes squared distances to the nearest seed along one line of the lattice from those of the passes before: the
/// lower envelope of parabolas (Felzenszwalb and Huttenlocher 2012), in O(n).
void lower_envelope(std::vector<float>& f, std::vector<float>& result, std::vector<int>& apex,
                    std::vector<float>& border) {
    const int n = static_cast<int>(f.size());
    constexpr float far = 1e12f;
    int k = 0;
    apex[0] = 0;
    border[0] = -far;
    border[1] = far;
    const auto at = [&](int i) { return f[static_cast<std::size_t>(i)]; };
    const auto meet = [&](int p, int q) {
        return ((at(q) + static_cast<float>(q) * static_cast<float>(q)) -
                (at(p) + static_cast<float>(p) * static_cast<float>(p))) /
               (2 * static_cast<float>(q - p));
    };
    for (int q = 1; q < n; ++q) {
        float s = meet(apex[static_cast<std::size_t>(k)], q);
        while (k > 0 && s <= border[static_cast<std::size_t>(k)]) {
            --k;
            s = meet(apex[static_cast<std::size_t>(k)], q);
        }
        ++k;
        apex[static_cast<std::size_t>(k)] = q;
        border[static_cast<std::size_t>(k)] = s;
        border[static_cast<std::size_t>(k) + 1] = far;
    }
    k = 0;
    for (int q = 0; q < n; ++q) {
        while (border[static_cast<std::size_t>(k) + 1] < static_cast<float>(q)) {
            ++k;
        }
        const float d = static_cast<float>(q - apex[static_cast<std::size_t>(k)]);
        result[static_cast<std::size_t>(q)] = d * d + at(apex[static_cast<std::size_t>(k)]);
    }
}

/// Runs one pass over all lines of the lattice that start at start(i) and continue by `stride`.
template <class Start>
void distance_pass(std::vector<float>& squared, std::size_t lines, std::size_t length, std::size_t stride,
                   Start start) {
    std::vector<float> f(length), result(length), border(length + 1);
    std::vector<int> apex(length);
    for (std::size_t line = 0; line < lines; ++line) {
        const std::size_t first = start(line);
        for (std::size_t i = 0; i < length; ++i) {
            f[i] = squared[first + i * stride];
        }
        lower_envelope(f, result, apex, border);
        for (std::size_t i = 0; i < length; ++i) {
            squared[first + i * stride] = result[i];
        }
    }
}

/// The cells of a lattice.
struct Cells {
    double size = 0;         ///< of a cell
    int count[3]{};          ///< along each axis
    double low[3]{};         ///< corner of the first cell
    std::size_t stride[3]{}; ///< from a cell to the next along each axis

    std::size_t total() const { return stride[2] * static_cast<std::size_t>(count[2]); }
    Vec3 middle(std::size_t i) const {
        return {low[0] + size * (static_cast<double>(i % stride[1]) + 0.5),
                low[1] + size * (static_cast<double>(i / stride[1] % static_cast<std::size_t>(count[1])) + 0.5),
                low[2] + size * (static_cast<double>(i / stride[2]) + 0.5)};
    }
};

/// Returns the cells of this size over the bounds, about the middle, with a margin of one cell all around.
Cells cells_over(const Vec3& bounds, double size) {
    Cells cells;
    cells.size = size;
    for (int k = 0; k < 3; ++k) {
        cells.count[k] = static_cast<int>(std::ceil(bounds[k] / size)) + 2;
        cells.low[k] = -size * cells.count[k] / 2;
        cells.stride[k] = k == 0 ? 1 : cells.stride[k - 1] * static_cast<std::size_t>(cells.count[k - 1]);
    }
    return cells;
}

/// The sums over lines for each cell: how much of it is inside, and the number of lines with a result.
struct Tally {
    std::vector<float> filled, spoke;
};

/// Adds the lines along an axis. Returns whether all of them separate inside and outside.
bool add_lines(const Solid& solid, const Frame& frame, const Cells& cells, int axis, Tally& tally) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    LineLattice lattice;
    lattice.axis = axis;
    lattice.step = cells.size / lines_per_cell;
    lattice.low[0] = cells.low[u] + lattice.step / 2;
    lattice.low[1] = cells.low[v] + lattice.step / 2;
    lattice.count[0] = cells.count[u] * lines_per_cell;
    lattice.count[1] = cells.count[v] * lines_per_cell;
    const LinePieces lines = pieces_along(solid.surface(), frame, lattice);
    const std::size_t stride = cells.stride[axis];
    for (std::size_t line = 0; line < lines.sound.size(); ++line) {
        const std::size_t iu = line % static_cast<std::size_t>(lattice.count[0]) / lines_per_cell;
        const std::size_t iv = line / static_cast<std::size_t>(lattice.count[0]) / lines_per_cell;
        const std::size_t first = iu * cells.stride[u] + iv * cells.stride[v];
        if (!lines.sound[line]) {
            continue;
        }
        for (int i = 0; i < cells.count[axis]; ++i) {
            tally.spoke[first + static_cast<std::size_t>(i) * stride] += 1;
        }
        for (std::size_t k = lines.first[line]; k < lines.first[line + 1]; ++k) {
            const double enter = (lines.pieces[k].first - cells.low[axis]) / cells.size;
            const double leave = (lines.pieces[k].second - cells.low[axis]) / cells.size;
            const int from = std::clamp(static_cast<int>(enter), 0, cells.count[axis] - 1);
            const int to = std::clamp(static_cast<int>(leave), 0, cells.count[axis] - 1);
            for (int i = from; i <= to; ++i) {
                const double share = std::min(leave, i + 1.0) - std::max(enter, static_cast<double>(i));
                tally.filled[first + static_cast<std::size_t>(i) * stride] += static_cast<float>(std::max(0.0, share));
            }
        }
    }
    return std::all_of(lines.sound.begin(), lines.sound.end(), [](char sound) { return sound != 0; });
}

/// Returns the outside share of each cell. Cells without lines use the winding number at their centre.
std::vector<float> shares_outside(const Solid& solid, const Frame& frame, const Cells& cells, const Tally& tally) {
    std::vector<float> outside(cells.total());
    std::vector<std::size_t> unknown;
    for (std::size_t i = 0; i < outside.size(); ++i) {
        outside[i] = tally.spoke[i] > 0 ? 1 - tally.filled[i] / tally.spoke[i] : 1;
        if (tally.spoke[i] == 0) {
            unknown.push_back(i);
        }
    }
    parallel_for(unknown.size(), [&](std::size_t k) {
        outside[unknown[k]] = solid.contains(frame.from_unit(cells.middle(unknown[k]))) ? 0.0f : 1.0f;
    });
    return outside;
}

} // namespace

Occupancy::Occupancy(const Solid& solid, const Frame& frame, int resolution) {
    const Vec3 size = solid.bounds().size() / frame.unit;
    const double cell = std::max({size.x, size.y, size.z, 1e-3}) / resolution;
    const Cells cells = cells_over(size, cell);
    inverse_ = static_cast<float>(1 / cell);
    for (int k = 0; k < 3; ++k) {
        low_[k] = static_cast<float>(cells.low[k] + cell / 2);
        last_[k] = static_cast<float>(cells.count[k] - 1);
    }
    row_ = static_cast<std::size_t>(cells.count[0]);
    rows_ = static_cast<std::size_t>(cells.count[1]);
    slices_ = static_cast<std::size_t>(cells.count[2]);
    Tally tally{std::vector<float>(cells.total(), 0), std::vector<float>(cells.total(), 0)};
    for (int axis = 0; axis < 3; ++axis) {
        const bool sound = add_lines(solid, frame, cells, axis, tally);
        if (sound && solid.closed()) { // one direction is enough
            break;
        }
    }
    outside_ = shares_outside(solid, frame, cells, tally);
    for (std::size_t i = 0; i < outside_.size(); ++i) {
        volume_ += (1 - outside_[i]) * cell * cell * cell;
        if (outside_[i] <= 0.5f) {
            inside_.add(cells.middle(i));
        }
    }
    find_depths();
}

void Occupancy::find_depths() {
    std::vector<float> squared(outside_.size());
    for (std::size_t i = 0; i < outside_.size(); ++i) {
        squared[i] = outside_[i] > 0.5f ? 0.0f : 1e9f;
    }
    distance_pass(squared, rows_ * slices_, row_, 1, [&](std::size_t line) { return line * row_; });
    distance_pass(squared, row_ * slices_, rows_, row_,
                  [&](std::size_t line) { return line / row_ * row_ * rows_ + line % row_; });
    distance_pass(squared, row_ * rows_, slices_, row_ * rows_, [](std::size_t line) { return line; });
    for (std::size_t i = 0; i < outside_.size(); ++i) {
        if (outside_[i] <= 0.5f) {
            depth_.push_back((std::sqrt(squared[i]) - 0.5f) / inverse_);
        }
    }
}

} // namespace foam::search::by_spheres
