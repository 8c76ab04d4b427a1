// approximate.*: covering convex elements of foam/search/cover.hpp as stages.
#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/sdk/plugin.hpp>
#include <foam/search/cover.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>

namespace {

using Kind = foam::Element::Kind;

struct Settings {
    std::vector<Kind> kinds;
    foam::CoverOptions options;
    std::size_t elements; ///< without a budget
};

/// Covers of one shape: what the counts have in common is computed once.
class Search final : public foam::SphereSearch {
public:
    Search(const foam::Shape& shape, const Settings& settings) : shape_(shape), settings_(settings) {}

    std::vector<foam::SphereTree> at_most(std::span<const foam::Budget> budgets, foam::Context& context) override {
        context.check_cancelled();
        const foam::WindUpScope scope; // the search polls the request itself, and returns its result so far
        context_ = &context;
        std::vector<foam::SphereTree> trees;
        for (const foam::Budget& budget : budgets) {
            foam::Cover cover = cover_for(budget);
            trees.push_back(
                foam::flat_tree(std::move(cover.elements)));
        }
        return trees;
    }

private:
    /// Returns the search for elements of these kinds.
    foam::CoverSearch& search_with(const std::vector<Kind>& kinds) {
        std::unique_ptr<foam::CoverSearch>& search = searches_[kinds];
        if (!search) {
            foam::CoverOptions options = settings_.options;
            options.kinds = kinds;
            options.stop = [this] { return context_->cancelled(); };
            search = std::make_unique<foam::CoverSearch>(shape_.original(), options);
        }
        return *search;
    }

    /// Returns the cover of the most elements that the budget allows; one element may cost more.
    foam::Cover cover_for(const foam::Budget& budget) {
        std::size_t most = budget.max_spheres.value_or(budget.max_cost ? SIZE_MAX : settings_.elements);
        if (!budget.max_cost) {
            return search_with(settings_.kinds).cover(most);
        }
        foam::CoverSearch& search = search_with(affordable_kinds(*budget.max_cost, budget.cost));
        most = std::min(most, affordable(*budget.max_cost, budget.cost));
        while (true) {
            foam::Cover cover = search.cover(most);
            const double price = foam::price_of(cover.elements, budget.cost);
            if (most == 1 || price <= *budget.max_cost) {
                return cover;
            }
            const double share = *budget.max_cost / price * static_cast<double>(std::min(most, cover.elements.size()));
            most = std::clamp<std::size_t>(static_cast<std::size_t>(share), 1, most - 1);
        }
    }

    /// Returns the kinds of which one element costs at most so much; if there are none, the cheapest.
    std::vector<Kind> affordable_kinds(double most, const foam::ElementCost& cost) const {
        most = std::max(most, foam::least_price(settings_.kinds, cost)) * (1 + 1e-9);
        std::vector<Kind> kinds;
        std::copy_if(settings_.kinds.begin(), settings_.kinds.end(), std::back_inserter(kinds),
                     [&](Kind kind) { return foam::least_price({kind}, cost) <= most; });
        return kinds;
    }

    /// Returns the most elements that are tried for a budget of cost: most hulls have at least as many vertices as a
    /// box.
    std::size_t affordable(double most, const foam::ElementCost& cost) const {
        const std::vector<Kind> hulls{Kind::hull};
        const double cheapest =
            settings_.kinds == hulls ? 8 * cost.of_hull_vertex : foam::least_price(settings_.kinds, cost);
        return cheapest * most_elements > most
                   ? std::max<std::size_t>(1, static_cast<std::size_t>(most / cheapest * (1 + 1e-9)))
                   : most_elements;
    }

    static constexpr std::size_t most_elements = 256;
    const foam::Shape& shape_;
    const Settings& settings_;
    foam::Context* context_ = nullptr;                                                 ///< of the present call
    std::map<std::vector<Kind>, std::unique_ptr<foam::CoverSearch>> searches_; ///< by kinds
};

/// Reads what all stages here have in common; the constructors of the stages add their own.
Settings settings_of(const foam::Parameters& parameters, std::vector<Kind> kinds) {
    Settings settings{.kinds = std::move(kinds), .options = {}, .elements = 0};
    settings.options.effort = foam::effort_named(parameters.text("effort")).value();
    settings.options.objective = foam::objective_named(parameters.text("objective")).value();
    settings.elements = static_cast<std::size_t>(parameters.integer("elements"));
    return settings;
}

class Approximator : public foam::Spherizer {
public:
    foam::SphereTree spherize(const foam::Shape& shape, const foam::Budget& budget,
                              foam::Context& context) const override {
        return search(shape)->at_most({&budget, 1}, context).front();
    }
    std::unique_ptr<foam::SphereSearch> search(const foam::Shape& shape) const override {
        return std::make_unique<Search>(shape, settings_);
    }

protected:
    explicit Approximator(Settings settings) : settings_(std::move(settings)) {}
    Settings settings_;
};

class Capsules final : public Approximator {
public:
    explicit Capsules(const foam::Parameters& p) : Approximator(settings_of(p, {Kind::capsule})) {}
};

class Cylinders final : public Approximator {
public:
    explicit Cylinders(const foam::Parameters& p) : Approximator(settings_of(p, {Kind::cylinder})) {}
};

class Boxes final : public Approximator {
public:
    explicit Boxes(const foam::Parameters& p) : Approximator(settings_of(p, {Kind::box})) {
        settings_.options.axis_aligned = p.boolean("axis_aligned");
    }
};

class SweptBoxes final : public Approximator {
public:
    explicit SweptBoxes(const foam::Parameters& p) : Approximator(settings_of(p, {Kind::swept_box})) {}
};

class Ellipsoids final : public Approximator {
public:
    explicit Ellipsoids(const foam::Parameters& p) : Approximator(settings_of(p, {Kind::ellipsoid})) {}
};

class Hulls final : public Approximator {
public:
    explicit Hulls(const foam::Parameters& p) : Approximator(settings_of(p, {Kind::hull})) {
        settings_.options.max_vertices = static_cast<std::size_t>(p.integer("max_vertices"));
    }
};

/// Returns the kinds of "capsule, box". Throws Error(usage) for another word, and for none.
std::vector<Kind> kinds_in(const std::string& text) {
    std::string words = text;
    std::replace(words.begin(), words.end(), ',', ' ');
    std::vector<std::string> separate;
    for (const std::string_view word : foam::words(words)) {
        separate.emplace_back(word);
    }
    std::vector<Kind> kinds = foam::kinds_named(separate, "approximate.mixed: kinds");
    if (kinds.empty()) {
        throw foam::Error(foam::ErrorCode::usage, "approximate.mixed: kinds names no kind; remedy: \"capsule, box\"");
    }
    return kinds;
}

class Mixed final : public Approximator {
public:
    explicit Mixed(const foam::Parameters& p) : Approximator(settings_of(p, kinds_in(p.text("kinds")))) {}
};

/// Returns the parameters of all stages, after the stage's own.
std::vector<foam::Parameter> with_common(std::vector<foam::Parameter> own, const char* objective) {
    own.push_back(foam::Parameter::choice("effort", {"fast", "normal", "best"}, "normal")
                      .doc("How long to search: fast takes about a third of the time of normal, best some ten times as "
                           "long."));
    own.push_back(foam::Parameter::choice("objective", {"excess", "mean_protrusion", "protrusion"}, objective)
                      .doc("What is minimised: the excess volume, the mean protrusion, or the largest protrusion."));
    own.push_back(foam::Parameter::integer("elements", 1).bounds(1, 256).doc("Number of elements without a budget."));
    return own;
}

foam::StageInfo info(std::string name, std::string summary, std::string reference,
                     std::vector<foam::Parameter> parameters, std::vector<Kind> kinds) {
    foam::StageInfo info;
    info.name = std::move(name);
    info.summary = std::move(summary);
    info.reference = std::move(reference);
    info.parameters = std::move(parameters);
    info.original_only = true;
    info.objective_parameter = "objective";
    info.kinds = std::move(kinds);
    info.revision = 7;
    return info;
}

} // namespace

FOAM_PLUGIN("approximate", "1.0", "Apache-2.0") {
    enrol.add<Capsules>(info("approximate.capsules",
                             "Covering capsules with the least excess volume: parts between planes, the least capsule "
                             "around each; proved.",
                             "Sharir and Welzl: A combinatorial bound for linear programming and related problems. "
                             "STACS 1992",
                             with_common({}, "excess"), {Kind::capsule}));
    enrol.add<Boxes>(info(
        "approximate.boxes",
        "Covering oriented boxes with the least excess volume: parts between planes, the least box "
        "around each; proved.",
        "O'Rourke: Finding minimal enclosing boxes. International Journal of Computer and "
        "Information Sciences 14, 1985",
        with_common({foam::Parameter::boolean("axis_aligned", false).doc("Boxes along the axes of the link's frame.")},
                    "excess"),
        {Kind::box}));
    enrol.add<SweptBoxes>(
        info("approximate.swept_boxes",
             "Covering boxes with round edges with the least excess volume: parts between planes, the "
             "least swept box around each; proved.",
             "Larsen, Gottschalk, Lin, Manocha: Fast proximity queries with swept sphere volumes. ICRA "
             "2000",
             with_common({}, "excess"), {Kind::swept_box}));
    enrol.add<Ellipsoids>(info("approximate.ellipsoids",
                               "Covering ellipsoids with the least excess volume: parts between planes, the least "
                               "ellipsoid around each; proved.",
                               "Todd and Yıldırım: On Khachiyan's algorithm for the computation of minimum-volume "
                               "enclosing ellipsoids. Discrete Applied Mathematics 155, 2007",
                               with_common({}, "excess"), {Kind::ellipsoid}));
    enrol.add<Cylinders>(info("approximate.cylinders",
                              "Covering cylinders with the least excess volume: parts between planes, the least "
                              "cylinder around each; proved.",
                              "Schömer, Sellen, Teichmann, Yap: Smallest enclosing cylinders. Algorithmica 27, 2000",
                              with_common({}, "excess"), {Kind::cylinder}));
    enrol.add<Hulls>(info("approximate.hulls",
                          "Convex pieces with the least excess volume: space is cut along concave edges, then cells "
                          "whose common hull adds least are put together; proved.",
                          "Mamou and Ghorbel: A simple and efficient approach for 3D mesh approximate convex "
                          "decomposition. ICIP 2009",
                          with_common({foam::Parameter::integer("max_vertices", 64)
                                           .bounds(4, 100'000)
                                           .source("most vertices of a convex shape in PhysX's GPU pipeline")
                                           .doc("Most vertices of a hull; larger hulls are simplified outwards.")},
                                      "excess"),
                          {Kind::hull}));
    enrol.add<Mixed>(info("approximate.mixed",
                          "Covering elements of several kinds, for each part the one that adds least; "
                          "proved.",
                          "Thiery, Guy, Boubekeur: Sphere-Meshes. ACM Transactions on Graphics 32, 2013",
                          with_common({foam::Parameter::text("kinds", "sphere, capsule, cylinder, box")
                                           .doc(fmt::format("The kinds of elements to choose from: {}.", fmt::join(foam::kind_words(), ", ")))},
                                      "mean_protrusion"),
                          foam::every_kind()));
}
