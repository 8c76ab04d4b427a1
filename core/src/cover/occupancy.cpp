#include "cover/occupancy.hpp"

#include "cover/lines.hpp"

#include <foam/parallel.hpp>

#include <algorithm>
#include <cmath>

namespace foam::cover {
namespace {

/// Lines a cell, along each of the two directions across.
constexpr int lines_per_cell = 2;

/// Squared distances to the nearest seed along one line of the lattice, given those of the passes before: the lower
/// envelope of parabolas (Felzenszwalb and Huttenlocher 2012), in O(n).
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

/// One pass over all lines of the lattice that start at start(i) and go on by `stride`.
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

} // namespace

Occupancy::Occupancy(const Solid& solid, const Frame& frame, int resolution) {
    const Vec3 size = solid.bounds().size() / frame.unit;
    const double cell = std::max({size.x, size.y, size.z, 1e-3}) / resolution;
    inverse_ = static_cast<float>(1 / cell);
    int count[3];
    double low[3]; // corner of the first cell; a cell is left free all around
    for (int k = 0; k < 3; ++k) {
        count[k] = static_cast<int>(std::ceil(size[k] / cell)) + 2;
        low[k] = -cell * count[k] / 2;
        low_[k] = static_cast<float>(low[k] + cell / 2);
        last_[k] = static_cast<float>(count[k] - 1);
    }
    row_ = static_cast<std::size_t>(count[0]);
    rows_ = static_cast<std::size_t>(count[1]);
    slices_ = static_cast<std::size_t>(count[2]);
    // What lines say of cells: how much of them is inside, and how many spoke.
    std::vector<float> filled(row_ * rows_ * slices_, 0), spoke(filled.size(), 0);
    const std::size_t stride[3]{1, row_, row_ * rows_};
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        LineLattice lattice;
        lattice.axis = axis;
        lattice.step = cell / lines_per_cell;
        lattice.low[0] = low[u] + lattice.step / 2;
        lattice.low[1] = low[v] + lattice.step / 2;
        lattice.count[0] = count[u] * lines_per_cell;
        lattice.count[1] = count[v] * lines_per_cell;
        const LinePieces lines = pieces_along(solid.surface(), frame, lattice);
        for (std::size_t line = 0; line < lines.sound.size(); ++line) {
            const std::size_t iu = line % static_cast<std::size_t>(lattice.count[0]) / lines_per_cell;
            const std::size_t iv = line / static_cast<std::size_t>(lattice.count[0]) / lines_per_cell;
            const std::size_t first = iu * stride[u] + iv * stride[v];
            if (!lines.sound[line]) {
                continue;
            }
            for (int i = 0; i < count[axis]; ++i) {
                spoke[first + static_cast<std::size_t>(i) * stride[axis]] += 1;
            }
            for (std::size_t k = lines.first[line]; k < lines.first[line + 1]; ++k) {
                const double enter = (lines.pieces[k].first - low[axis]) / cell;
                const double leave = (lines.pieces[k].second - low[axis]) / cell;
                const int from = std::clamp(static_cast<int>(enter), 0, count[axis] - 1);
                const int to = std::clamp(static_cast<int>(leave), 0, count[axis] - 1);
                for (int i = from; i <= to; ++i) {
                    const double share = std::min(leave, i + 1.0) - std::max(enter, static_cast<double>(i));
                    filled[first + static_cast<std::size_t>(i) * stride[axis]] +=
                        static_cast<float>(std::max(0.0, share));
                }
            }
        }
        // On a closed surface one direction says it all.
        if (solid.closed() &&
            std::all_of(lines.sound.begin(), lines.sound.end(), [](char sound) { return sound != 0; })) {
            break;
        }
    }
    outside_.resize(filled.size());
    std::vector<std::size_t> unknown;
    for (std::size_t i = 0; i < filled.size(); ++i) {
        outside_[i] = spoke[i] > 0 ? 1 - filled[i] / spoke[i] : 1;
        if (spoke[i] == 0) {
            unknown.push_back(i);
        }
    }
    const auto middle = [&](std::size_t i) {
        return Vec3{low[0] + cell * (static_cast<double>(i % row_) + 0.5),
                    low[1] + cell * (static_cast<double>(i / row_ % rows_) + 0.5),
                    low[2] + cell * (static_cast<double>(i / row_ / rows_) + 0.5)};
    };
    parallel_for(unknown.size(), [&](std::size_t k) {
        outside_[unknown[k]] = solid.contains(frame.from_unit(middle(unknown[k]))) ? 0.0f : 1.0f;
    });
    for (std::size_t i = 0; i < outside_.size(); ++i) {
        volume_ += (1 - outside_[i]) * cell * cell * cell;
        if (outside_[i] <= 0.5f) {
            inside_.add(middle(i));
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

} // namespace foam::cover
