// The edges that may go, the cheapest first.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace foam::simplify {

/// Edge u v and what its collapse costs.
struct Candidate {
    double cost;
    std::uint32_t u, v;
    std::uint32_t stamp_u, stamp_v; ///< of the vertices when the cost was computed

    bool operator<(const Candidate& other) const {
        return cost != other.cost ? cost < other.cost : u != other.u ? u < other.u : v < other.v;
    }
};

/// The edges of the mesh are sorted once and read in their order; those that come in while edges are collapsed wait in
/// a heap, which stays small: candidates that have become stale are swept out of it as it grows.
class Candidates {
public:
    explicit Candidates(std::vector<Candidate> all) : sorted_(std::move(all)) {
        std::sort(sorted_.begin(), sorted_.end());
    }

    bool empty() const { return next_ == sorted_.size() && heap_.empty(); }

    /// Removes the cheapest one.
    Candidate pop() {
        if (heap_.empty() || (next_ < sorted_.size() && sorted_[next_] < heap_.front())) {
            return sorted_[next_++];
        }
        std::pop_heap(heap_.begin(), heap_.end(), Dearer());
        const Candidate candidate = heap_.back();
        heap_.pop_back();
        return candidate;
    }

    /// `is_stale` tells of a candidate whether it may be dropped.
    template <class IsStale> void push(const Candidate& candidate, IsStale is_stale) {
        if (heap_.size() >= limit_) {
            std::erase_if(heap_, is_stale);
            std::make_heap(heap_.begin(), heap_.end(), Dearer());
            limit_ = std::max(limit_, 2 * heap_.size());
        }
        heap_.push_back(candidate);
        std::push_heap(heap_.begin(), heap_.end(), Dearer());
    }

private:
    struct Dearer {
        bool operator()(const Candidate& a, const Candidate& b) const { return b < a; }
    };

    std::vector<Candidate> sorted_, heap_;
    std::size_t next_ = 0; // in sorted_
    std::size_t limit_ = 4096;
};

} // namespace foam::simplify
