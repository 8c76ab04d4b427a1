// The edges that may collapse, the least cost first.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <vector>

namespace foam::simplify {

/// Edge u v and the cost of its collapse.
struct Candidate {
    double cost;
    std::uint32_t u, v;
    std::uint32_t stamp_u, stamp_v; ///< of the vertices when the cost was computed

    bool operator>(const Candidate& other) const {
        return cost != other.cost ? cost > other.cost : u != other.u ? u > other.u : v > other.v;
    }
};

/// A priority queue that reads and writes memory in order, as in Sanders: Fast Priority Queues for Cached Memory, 2000.
/// A heap small enough for the cache takes new entries. A full heap becomes a sorted run, and runs of similar length
/// are merged. In one heap over the millions of edges of a large mesh every step would wait for memory.
class Candidates {
public:
    explicit Candidates(std::vector<Candidate> all) { add_run(std::move(all)); }

    bool empty() const { return runs_.empty() && heap_.empty(); }

    void push(const Candidate& candidate) {
        heap_.push_back(candidate);
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
        if (heap_.size() == heap_limit) {
            add_run(std::move(heap_));
            heap_.clear();
        }
    }

    /// Removes and returns the candidate with the least cost. Precondition: not empty().
    Candidate pop() {
        std::size_t cheapest = runs_.size(); // the heap
        for (std::size_t r = 0; r < runs_.size(); ++r) {
            if (cheapest == runs_.size() ? heap_.empty() || heap_.front() > runs_[r].back()
                                         : runs_[cheapest].back() > runs_[r].back()) {
                cheapest = r;
            }
        }
        if (cheapest == runs_.size()) {
            std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
            return taken_from(heap_);
        }
        const Candidate candidate = taken_from(runs_[cheapest]);
        if (runs_[cheapest].empty()) {
            runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(cheapest));
        }
        return candidate;
    }

private:
    using Run = std::vector<Candidate>; // the least cost at the end

    static constexpr std::size_t heap_limit = 8192;

    static Candidate taken_from(std::vector<Candidate>& list) {
        const Candidate candidate = list.back();
        list.pop_back();
        return candidate;
    }

    void add_run(std::vector<Candidate> candidates) {
        if (candidates.empty()) {
            return;
        }
        std::sort(candidates.begin(), candidates.end(), std::greater<>());
        runs_.push_back(std::move(candidates));
        while (runs_.size() > 1 && runs_[runs_.size() - 2].size() <= 2 * runs_.back().size()) {
            const Run last = std::move(runs_.back());
            runs_.pop_back();
            Run merged;
            merged.reserve(runs_.back().size() + last.size());
            std::merge(runs_.back().begin(), runs_.back().end(), last.begin(), last.end(), std::back_inserter(merged),
                       std::greater<>());
            runs_.back() = std::move(merged);
        }
    }

    std::vector<Run> runs_;
    std::vector<Candidate> heap_;
};

} // namespace foam::simplify
