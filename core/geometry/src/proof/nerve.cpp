#include "proof/nerve.hpp"

#include <foam/geometry/internal/proof.hpp>

#include <algorithm>

namespace foam::inline geometry {
namespace {

std::uint64_t key_of(std::uint64_t i, std::uint64_t j, std::uint64_t k = 0) {
    return k << 32 | j << 16 | i;
}

/// Reduces columns from left to right (Edelsbrunner, Letscher, Zomorodian, Topological persistence and simplification,
/// 2002, section 4). Returns for each of `rows` rows whether it is the last of a reduced column: their number is the
/// rank.
std::vector<char> last_rows(std::vector<std::vector<std::uint32_t>> columns, std::size_t rows) {
    constexpr std::uint32_t none = ~0U;
    std::vector<std::uint32_t> column_of(rows, none);
    std::vector<char> last(rows, 0);
    std::vector<std::uint32_t> sum;
    for (std::uint32_t c = 0; c < columns.size(); ++c) {
        std::vector<std::uint32_t>& column = columns[c];
        while (!column.empty() && column_of[column.back()] != none) {
            const std::vector<std::uint32_t>& other = columns[column_of[column.back()]];
            sum.clear();
            std::set_symmetric_difference(column.begin(), column.end(), other.begin(), other.end(),
                                          std::back_inserter(sum));
            column.swap(sum);
        }
        if (!column.empty()) {
            column_of[column.back()] = c;
            last[column.back()] = 1;
        }
    }
    return last;
}

} // namespace

Nerve::Nerve(const Bodies& bodies, const Walls& walls)
    : bodies_(bodies), common_point_(bodies, walls), most_simplices_(20'000 + 200 * bodies.size()),
      later_(bodies.size()) {
    doubt_ = bodies.size() >= 1U << 16; // beyond the keys
}

bool Nerve::holds_all(std::uint32_t witness, std::span<const std::uint32_t> corners) const {
    const std::vector<std::uint32_t>& holders = witnesses_[witness].holders;
    return std::all_of(corners.begin(), corners.end(),
                       [&](std::uint32_t c) { return std::binary_search(holders.begin(), holders.end(), c); });
}

std::uint32_t Nerve::edge(std::uint32_t i, std::uint32_t j) const {
    return edge_of_.at(key_of(i, j));
}

std::uint32_t Nerve::triangle(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
    return triangle_of_.at(key_of(i, j, k));
}

bool Nerve::meet(std::span<const std::uint32_t> corners, std::span<Simplex* const> faces) {
    asking_.check();
    Simplex simplex;
    std::copy(corners.begin(), corners.end(), simplex.corners.begin());
    std::vector<Simplex>& all = corners.size() == 2 ? edges_ : corners.size() == 3 ? triangles_ : tetrahedra_;
    Vec3 start{};
    for (const Simplex* face : faces) {
        if (holds_all(face->witness, corners)) {
            simplex.witness = face->witness;
            all.push_back(simplex);
            doubt_ = doubt_ || triangles_.size() + tetrahedra_.size() > most_simplices_;
            return true;
        }
        start += witnesses_[face->witness].point / static_cast<double>(faces.size());
    }
    if (faces.empty()) {
        start = (bodies_.bounds(corners[0]).center() + bodies_.bounds(corners[1]).center()) * 0.5;
    }
    const Meeting meeting = common_point_.find(corners, start);
    doubt_ = doubt_ || meeting == Meeting::doubt;
    if (meeting != Meeting::common) {
        return false;
    }
    simplex.witness = static_cast<std::uint32_t>(witnesses_.size());
    witnesses_.push_back({start, {}});
    bodies_.holders(start, [&](std::uint32_t k) { witnesses_.back().holders.push_back(k); });
    std::sort(witnesses_.back().holders.begin(), witnesses_.back().holders.end());
    all.push_back(simplex);
    return true;
}

bool Nerve::find_edges() {
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < bodies_.size() && !doubt_; ++i) {
        if (!bodies_.holds_something(i)) {
            continue;
        }
        bodies_.meeting(bodies_.bounds(i), near);
        for (auto k = std::upper_bound(near.begin(), near.end(), i); k != near.end(); ++k) {
            const std::array<std::uint32_t, 2> corners{i, *k};
            if (meet(corners, {})) {
                edge_of_[key_of(i, *k)] = static_cast<std::uint32_t>(edges_.size() - 1);
                later_[i].push_back(*k);
            }
        }
    }
    return !doubt_;
}

bool Nerve::find_triangles() {
    for (std::uint32_t i = 0; i < bodies_.size() && !doubt_; ++i) {
        for (std::size_t a = 0; a < later_[i].size(); ++a) {
            for (std::size_t b = a + 1; b < later_[i].size(); ++b) {
                const std::uint32_t j = later_[i][a], k = later_[i][b];
                if (edge_of_.contains(key_of(j, k))) {
                    const std::array faces{&edges_[edge(j, k)], &edges_[edge(i, k)], &edges_[edge(i, j)]};
                    if (meet(std::array{i, j, k}, faces)) {
                        triangle_of_[key_of(i, j, k)] = static_cast<std::uint32_t>(triangles_.size() - 1);
                    }
                }
            }
        }
    }
    return !doubt_;
}

bool Nerve::find_tetrahedra() {
    for (std::size_t n = 0; n < triangles_.size() && !doubt_; ++n) {
        const auto [i, j, k, none] = triangles_[n].corners;
        for (const std::uint32_t l : later_[k]) {
            if (triangle_of_.contains(key_of(i, j, l)) && triangle_of_.contains(key_of(i, k, l)) &&
                triangle_of_.contains(key_of(j, k, l))) {
                const std::array faces{&triangles_[n], &triangles_[triangle(i, j, l)], &triangles_[triangle(i, k, l)],
                                       &triangles_[triangle(j, k, l)]};
                meet(std::array{i, j, k, l}, faces);
            }
        }
    }
    return !doubt_;
}

Nerve::Columns Nerve::boundaries_of_tetrahedra() const {
    Columns columns;
    for (const Simplex& t : tetrahedra_) {
        const auto [i, j, k, l] = t.corners;
        columns.push_back({triangle(i, j, k), triangle(i, j, l), triangle(i, k, l), triangle(j, k, l)});
        std::sort(columns.back().begin(), columns.back().end());
    }
    return columns;
}

Nerve::Columns Nerve::boundaries_of_triangles(const std::vector<char>& left_out) const {
    Columns columns;
    for (std::size_t n = 0; n < triangles_.size(); ++n) {
        if (!left_out[n]) {
            const auto [i, j, k, none] = triangles_[n].corners;
            columns.push_back({edge(i, j), edge(i, k), edge(j, k)});
            std::sort(columns.back().begin(), columns.back().end());
        }
    }
    return columns;
}

/// The union has no void if each closed surface of triangles bounds a sum of tetrahedra. A triangle that is the last of
/// one that does adds nothing new to closed surfaces; the others must not make any.
bool Nerve::has_no_void() {
    if (doubt_ || !find_edges() || !find_triangles() || !find_tetrahedra()) {
        return false;
    }
    const std::vector<char> filled = last_rows(boundaries_of_tetrahedra(), triangles_.size());
    const Columns open = boundaries_of_triangles(filled);
    const std::vector<char> bounded = last_rows(open, edges_.size());
    return open.size() == static_cast<std::size_t>(std::count(bounded.begin(), bounded.end(), 1));
}

bool has_no_void(const Elements& elements) {
    constexpr std::uint32_t halvings = 120;
    const std::vector<Element> all(elements.begin(), elements.end());
    Box box;
    for (const Element& e : all) {
        if (is_valid(e)) {
            const Box of_element = bounds(e);
            box.add(of_element.low);
            box.add(of_element.high);
        }
    }
    const Vec3 origin = box.center();
    const Bodies bodies(elements, origin, reach_from(origin, all), halvings);
    return Nerve(bodies, Walls(all, bodies)).has_no_void();
}

} // namespace foam::inline geometry
