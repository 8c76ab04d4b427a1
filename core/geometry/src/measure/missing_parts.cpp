#include <foam/geometry/internal/measure_parts.hpp>

#include "solid/inside_lines.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <numeric>

namespace foam::inline geometry {

MissingParts::MissingParts(const Solid& solid)
    : lines_(inside_lines(solid)), near_(lines_.rows()), lengths_(lines_.rows()), rows_(lines_.rows()) {
    InsideLines::Scratch scratch;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        for (std::size_t line = 0; line < lines_.across(); ++line) {
            lengths_[row].push_back(lines_.length_outside(row, line, {}, scratch));
        }
        rows_[row] = std::accumulate(lengths_[row].begin(), lengths_[row].end(), 0.0);
    }
}

void MissingParts::take(std::span<const Sphere> balls) {
    std::vector<Sphere> changed; // before and after the change
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < std::max(balls_.size(), balls.size()); ++i) {
        const bool was = i < balls_.size(), is = i < balls.size();
        if (was && is && balls_[i] == balls[i]) {
            continue;
        }
        places.push_back(i);
        if (was) {
            changed.push_back(balls_[i]);
        }
        if (is) {
            changed.push_back(balls[i]);
        }
    }
    balls_.assign(balls.begin(), balls.end());
    std::vector<Sphere> near, moved;
    InsideLines::Scratch scratch;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        check_cancelled();
        lines_.balls_at(row, changed, moved);
        if (moved.empty()) {
            continue;
        }
        std::vector<std::uint32_t>& here = near_[row];
        std::erase_if(here, [&](std::uint32_t i) { return std::binary_search(places.begin(), places.end(), i); });
        for (const std::uint32_t i : places) {
            if (i < balls_.size() && lines_.reaches(row, balls_[i])) {
                here.insert(std::upper_bound(here.begin(), here.end(), i), i);
            }
        }
        near.clear();
        for (const std::uint32_t i : here) {
            near.push_back(balls_[i]);
        }
        for (std::size_t line = 0; line < lines_.across(); ++line) {
            if (lines_.meets_any(row, line, moved)) {
                lengths_[row][line] = lines_.length_outside(row, line, near, scratch);
            }
        }
        rows_[row] = std::accumulate(lengths_[row].begin(), lengths_[row].end(), 0.0);
    }
}

double MissingParts::volume() const {
    double sum = 0;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        sum += lines_.share(row) * rows_[row];
    }
    return sum;
}

double MissingParts::volume_with(std::size_t i, const Sphere& first, const Sphere& second) const {
    const std::array changed{balls_[i], first, second};
    std::vector<Sphere> near, moved;
    InsideLines::Scratch scratch;
    double sum = 0;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        lines_.balls_at(row, changed, moved);
        double outside = rows_[row];
        if (!moved.empty()) {
            near.assign({first, second});
            for (const std::uint32_t k : near_[row]) {
                if (k != i) {
                    near.push_back(balls_[k]);
                }
            }
            outside = 0;
            for (std::size_t line = 0; line < lines_.across(); ++line) {
                outside += lines_.meets_any(row, line, moved) ? lines_.length_outside(row, line, near, scratch)
                                                              : lengths_[row][line];
            }
        }
        sum += lines_.share(row) * outside;
    }
    return sum;
}

} // namespace foam::geometry
