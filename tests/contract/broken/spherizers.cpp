// Spherizers that are good but for one thing each.
#include <foam/sdk/plugin.hpp>

#include <atomic>
#include <stdexcept>

namespace {

using namespace foam;

SphereTree one_ball(const Shape& shape, Context& context) {
    context.check_cancelled();
    return flat_tree({minimum_enclosing_sphere(shape.original().surface().vertices)});
}

class Good final : public Spherizer {
public:
    SphereTree spherize(const Shape& shape, const Budget&, Context& context) const override {
        return one_ball(shape, context);
    }
};

class TooMany final : public Spherizer {
public:
    SphereTree spherize(const Shape& shape, const Budget&, Context& context) const override {
        const Sphere ball = one_ball(shape, context).finest().front();
        return flat_tree({ball, ball});
    }
};

class TooSmall final : public Spherizer {
public:
    SphereTree spherize(const Shape& shape, const Budget&, Context& context) const override {
        Sphere ball = one_ball(shape, context).finest().front();
        ball.radius /= 2;
        return flat_tree({ball});
    }
};

class NotFinite final : public Spherizer {
public:
    SphereTree spherize(const Shape& shape, const Budget&, Context& context) const override {
        SphereTree tree = one_ball(shape, context);
        tree.levels.back().elements.spheres().front().center.y = std::numeric_limits<double>::quiet_NaN();
        return tree;
    }
};

class Empty final : public Spherizer {
public:
    SphereTree spherize(const Shape&, const Budget&, Context& context) const override {
        context.check_cancelled();
        return {};
    }
};

class CountsItsCalls final : public Spherizer {
public:
    SphereTree spherize(const Shape& shape, const Budget&, Context& context) const override {
        Sphere ball = one_ball(shape, context).finest().front();
        ball.radius *= 1 + 1e-6 * static_cast<double>(++calls_);
        return flat_tree({ball});
    }

private:
    mutable std::atomic<int> calls_ = 0;
};

/// Larger balls for counts below the largest so far.
class KeepsTheLargest final : public Spherizer {
public:
    SphereTree spherize(const Shape& shape, const Budget& budget, Context& context) const override {
        return search(shape)->at_most({&budget, 1}, context).front();
    }
    std::unique_ptr<SphereSearch> search(const Shape& shape) const override {
        class Search final : public SphereSearch {
        public:
            explicit Search(const Shape& of) : shape_(of) {}
            std::vector<SphereTree> at_most(std::span<const Budget> budgets, Context& context) override {
                std::vector<SphereTree> trees;
                for (const Budget& budget : budgets) {
                    const std::size_t count = budget.max_spheres.value_or(1);
                    Sphere ball = one_ball(shape_, context).finest().front();
                    ball.radius *= count < largest_ ? 1.01 : 1;
                    largest_ = std::max(largest_, count);
                    trees.push_back(flat_tree({ball}));
                }
                return trees;
            }

        private:
            const Shape& shape_;
            std::size_t largest_ = 0;
        };
        return std::make_unique<Search>(shape);
    }
};

class NeverStops final : public Spherizer {
public:
    SphereTree spherize(const Shape& shape, const Budget&, Context&) const override {
        QuietContext deaf;
        return one_ball(shape, deaf);
    }
};

class Throws final : public Spherizer {
public:
    SphereTree spherize(const Shape& shape, const Budget&, Context& context) const override {
        context.check_cancelled();
        if (shape.name() == "Needle") {
            throw std::out_of_range("no such cell");
        }
        return one_ball(shape, context);
    }
};

class LooksAtProcessed final : public Spherizer {
public:
    SphereTree spherize(const Shape& shape, const Budget&, Context& context) const override {
        const Box box = shape.processed().bounds();
        const Sphere ball = one_ball(shape, context).finest().front();
        return flat_tree({{ball.center, std::max(ball.radius, box.diagonal() / 2)}});
    }
};

class Confused final : public Spherizer {
public:
    explicit Confused(const Parameters& parameters) : radius_(parameters.text("aim") == "radius") {}
    SphereTree spherize(const Shape& shape, const Budget&, Context& context) const override {
        Sphere ball = one_ball(shape, context).finest().front();
        ball.radius *= radius_ ? 1.2 : 1;
        return flat_tree({ball});
    }

private:
    bool radius_;
};

class Picky final : public Spherizer {
public:
    explicit Picky(const Parameters& parameters) {
        if (parameters.integer("cells") == 0) {
            throw std::invalid_argument("no cells");
        }
    }
    SphereTree spherize(const Shape& shape, const Budget&, Context& context) const override {
        return one_ball(shape, context);
    }
};

} // namespace

FOAM_PLUGIN("broken_spherizers", "1.0", "Apache-2.0") {
    enrol.add<Good>({.name = "spherize.good", .summary = "Keeps all promises"});
    enrol.add<TooMany>({.name = "spherize.too_many", .summary = "Two spheres whatever the budget"});
    enrol.add<TooSmall>({.name = "spherize.too_small", .summary = "Half the radius"});
    enrol.add<NotFinite>({.name = "spherize.not_finite", .summary = "A centre that is no number"});
    enrol.add<Empty>({.name = "spherize.empty", .summary = "No spheres"});
    enrol.add<CountsItsCalls>({.name = "spherize.counts", .summary = "Keeps a state between calls"});
    enrol.add<KeepsTheLargest>({.name = "spherize.order", .summary = "Depends on the order of the budgets"});
    enrol.add<NeverStops>({.name = "spherize.never_stops", .summary = "Deaf"});
    enrol.add<Throws>({.name = "spherize.throws", .summary = "Throws for one solid"});
    enrol.add<LooksAtProcessed>(
        {.name = "spherize.looks", .summary = "Says that it looks at the original alone", .original_only = true});
    enrol.add<Confused>(
        {.name = "spherize.confused",
         .summary = "Larger where they are to be small",
         .parameters = {Parameter::choice("aim", {"excess", "stiffness", "radius"}, "excess").doc("Aim.")},
         .objective_parameter = "aim"});
    enrol.add<Picky>({.name = "spherize.picky",
                      .summary = "Declares what it does not take",
                      .parameters = {Parameter::integer("cells", 1).at_least(0).doc("Cells."),
                                     Parameter::number("size", 1).doc("Size.")}});
}
