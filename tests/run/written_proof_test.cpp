// The proof on what is read back from a file: the last thing between a wrong number and its reader.
#include "geometry/shapes.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/inner.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/links.hpp>

#include <gmock/gmock.h>

#include <cmath>

namespace foam {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Read = std::map<std::string, std::vector<Sphere>>;

/// Proves spheres alone.
std::vector<WrittenProof> prove_spheres(const Read& read, const FinishedModel& finished, Guarantee guarantee,
                                        Numbers numbers, const std::string& file) {
    std::map<std::string, Elements> levels;
    for (const auto& [link, spheres] : read) {
        levels[link].spheres() = spheres;
    }
    return prove_written(levels, finished, guarantee, numbers, file);
}

/// Two links with a cube each, of which the second may be one that is not proved.
class WrittenProofs : public ::testing::Test {
protected:
    WrittenProofs() {
        names[0].name = "base";
        names[1].name = "tip";
        for (std::size_t i = 0; i < 2; ++i) {
            works[i].link = &names[i];
            works[i].report.measures.certified = true;
            finished.links.push_back({&works[i], Solid::make(test::box({-1, -1, -1}, {1, 1, 1})), {}});
        }
    }

    std::string failure(const Read& read, Guarantee guarantee = Guarantee::outer) const {
        try {
            prove_spheres(read, finished, guarantee, Numbers::float64, "out.csv");
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::internal);
            return error.what();
        }
        return "";
    }

    std::array<Link, 2> names;
    std::array<LinkWork, 2> works;
    FinishedModel finished;
};

TEST_F(WrittenProofs, TellWhatTheyTook) {
    const std::vector<Sphere> two{{{-0.5, 0, 0}, 1.6}, {{0.5, 0, 0}, 1.6}}, one{{{}, 2}};
    const std::vector<WrittenProof> proofs =
        prove_spheres({{"base", two}, {"tip", one}}, finished, Guarantee::outer, Numbers::float64, "f");
    ASSERT_EQ(proofs.size(), 2u);
    EXPECT_EQ(proofs[0].link, "base");
    EXPECT_EQ(proofs[0].spheres, 2u);
    EXPECT_EQ(proofs[0].triangles, 12u);
    EXPECT_EQ(proofs[0].pieces, certify(*finished.links[0].solid, two).pieces);
    EXPECT_GT(proofs[0].pieces, 12u);
    EXPECT_GE(proofs[0].halvings, 1u);
    EXPECT_EQ(proofs[1].link, "tip");
    EXPECT_EQ(proofs[1].spheres, 1u);
    EXPECT_EQ(proofs[1].pieces, 12u);
    EXPECT_EQ(proofs[1].halvings, 0u);
    const std::vector<WrittenProof> inner =
        prove_spheres({{"base", {{{}, 0.9}}}, {"tip", {{{}, 0.5}}}}, finished, Guarantee::inner, Numbers::float64, "f");
    ASSERT_EQ(inner.size(), 2u);
    EXPECT_EQ(inner[0].triangles, 12u);
    EXPECT_EQ(inner[0].pieces, 0u);
}

TEST_F(WrittenProofs, AnUlpThatAWriterLostIsFound) {
    // The least radius that is proved, as a file has it, and the next below; likewise the largest of an inner one.
    double low = 1.7, high = 1.8;
    while (std::nextafter(low, high) < high) {
        const double middle = low + (high - low) / 2;
        (certify(*finished.links[0].solid, std::vector<Sphere>{{{}, middle}}).holds ? high : low) = middle;
    }
    const std::vector<Sphere> good{{{}, 2}};
    EXPECT_EQ(failure({{"base", {{{}, *parse_number(number_text(high))}}}, {"tip", good}}), "");
    EXPECT_THAT(failure({{"base", {{{}, *parse_number(number_text(low))}}}, {"tip", good}}),
                HasSubstr("out.csv: link 'base': the certificate does not hold for the numbers read back: "));
    EXPECT_THAT(failure({{"base", good}, {"tip", {{{}, low}}}}), HasSubstr("out.csv: link 'tip': "));
    EXPECT_THAT(failure({{"base", {{{0, 0, 1}, 2}}}, {"tip", good}}), HasSubstr(" m are missing at ["));
    const double most = inner_radii(*finished.links[0].solid, std::vector<Sphere>{{{}, 9}}).front();
    EXPECT_EQ(failure({{"base", {{{}, most}}}, {"tip", {{{}, most}}}}, Guarantee::inner), "");
    EXPECT_THAT(
        failure({{"base", {{{}, 0.5}, {{}, 1 + 1e-15}}}, {"tip", {{{}, most}}}}, Guarantee::inner),
        HasSubstr("link 'base': the certificate does not hold for the numbers read back: sphere 1 protrudes by "));
    EXPECT_EQ(failure({{"base", good}, {"tip", good}}, Guarantee::inner) == "", false);
}

TEST_F(WrittenProofs, NoLinkMayLackItsSpheres) {
    const std::vector<Sphere> good{{{}, 2}};
    EXPECT_EQ(failure({{"base", good}}), "out.csv: link 'tip' has no spheres in the written file");
    EXPECT_EQ(failure({{"base", {}}, {"tip", good}}), "out.csv: link 'base' has no spheres in the written file");
    works[1].report.measures.certified = false;
    EXPECT_EQ(failure({{"base", good}}), "out.csv: link 'tip' has no spheres in the written file")
        << "whether proved or not";
}

TEST_F(WrittenProofs, SinglePrecisionIsProvedToo) {
    // A radius that covers, and of which the nearest number in single precision does not.
    const double radius = 1.75 + 0.25 * std::numeric_limits<float>::epsilon(), half = radius / std::sqrt(3.0) * (1 - 1e-12);
    for (FinishedLink& link : finished.links) {
        link.solid = Solid::make(test::box({-half, -half, -half}, {half, half, half}));
    }
    const std::vector<Sphere> tight{{{}, radius}}, good{{{}, 2}};
    const auto proofs = prove_spheres({{"base", tight}, {"tip", good}}, finished, Guarantee::outer, Numbers::float64, "f");
    ASSERT_EQ(proofs.size(), 2u);
    EXPECT_FALSE(proofs[0].float32);
    for (const auto& [spheres, told] : {std::pair{good, ""}, std::pair{tight, " read back in single precision: "}}) {
        try {
            const auto both = prove_spheres({{"base", spheres}, {"tip", good}}, finished, Guarantee::outer, Numbers::float32, "f");
            ASSERT_EQ(both.size(), 2u);
            EXPECT_TRUE(both[0].float32);
            EXPECT_TRUE(both[1].float32);
            EXPECT_STREQ(told, "");
        } catch (const Error& error) {
            EXPECT_STRNE(told, "");
            EXPECT_THAT(error.what(), HasSubstr(told));
        }
    }
    // And one that covers only in single precision.
    const double less = 1.75 - 0.25 * std::numeric_limits<float>::epsilon(), large = 1.75 / std::sqrt(3.0) * (1 - 1e-12);
    finished.links[0].solid = Solid::make(test::box({-large, -large, -large}, {large, large, large}));
    try {
        prove_spheres({{"base", {{{}, less}}}, {"tip", good}}, finished, Guarantee::outer, Numbers::float32, "f");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("the numbers read back: "));
    }
}

TEST_F(WrittenProofs, AReaderThatTakesOtherRadiiIsToldFromAnError) {
    // What shrinks or grows the largest radius by more than a hundred thousandth is a buffer.
    const double radius = std::sqrt(3.0) * (1 + 1e-9);
    const auto hint = [&](const std::vector<Sphere>& model, const std::vector<Sphere>& file, Guarantee guarantee) {
        finished.links[0].elements.spheres() = model;
        const std::vector<Sphere> good{{{}, guarantee == Guarantee::outer ? 2 : 0.5}};
        try {
            prove_spheres({{"base", file}, {"tip", good}}, finished, guarantee, Numbers::float64, "f");
        } catch (const Error& error) {
            const std::string told = error.what();
            const std::size_t at = told.find("; with its buffer, the file's reader takes radii that are ");
            EXPECT_EQ(error.code(), at == std::string::npos ? ErrorCode::internal : ErrorCode::output);
            return at == std::string::npos ? std::string("none") : told.substr(at + 58, told.find(" than the model's") - at - 58);
        }
        return std::string("proved");
    };
    EXPECT_EQ(hint({{{}, radius}}, {{{}, radius}}, Guarantee::outer), "proved");
    EXPECT_EQ(hint({{{}, radius}}, {{{}, radius * (1 - 0.9e-5)}}, Guarantee::outer), "none");
    EXPECT_THAT(hint({{{}, radius}}, {{{}, radius * (1 - 1.1e-5)}}, Guarantee::outer), HasSubstr(" m less"));
    EXPECT_EQ(hint({{{}, 1}}, {{{}, 1.5}}, Guarantee::inner), "0.5 m more");
    EXPECT_EQ(hint({{{}, 0.5}}, {{{}, 1.5}}, Guarantee::inner), "1 m more");
    EXPECT_EQ(hint({{{}, 1}}, {{{}, 1 + 0.9e-5}}, Guarantee::inner), "none");
    EXPECT_THAT(hint({{{}, 1}}, {{{}, 1 + 1.1e-5}}, Guarantee::inner), HasSubstr(" m more"));
    EXPECT_EQ(hint({}, {{{}, 1.5}}, Guarantee::inner), "none");
    // The largest counts, wherever it is.
    for (const double first : {0.25, 1.5}) {
        const std::vector<Sphere> model{{{}, first}, {{}, 1.75 - first}};
        EXPECT_EQ(hint(model, {{{}, 1.25}}, Guarantee::outer), "0.25 m less");
        EXPECT_EQ(hint({{{}, 1.75}}, model, Guarantee::outer), "0.25 m less");
    }
}

TEST_F(WrittenProofs, ElementsOfOtherKindsAreProvedUnlessTheyAreOptional) {
    const Element around{.kind = Element::Kind::box, .half = {1.01, 1.01, 1.01}};
    Element small = around;
    small.half.x = 0.99;
    finished.links[0].elements = {finished.links[0].elements.spheres(), {around}};
    const std::vector<Sphere> good{{{}, 2}};
    const auto proved = [&](const Elements& base, bool optional) {
        return prove_written({{"base", base}, {"tip", good}}, finished, Guarantee::outer, Numbers::float64, "f", optional);
    };
    const auto told = [&](const Elements& base) {
        try {
            proved(base, false);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::internal);
            return std::string(error.what());
        }
        return std::string();
    };
    const auto proofs = proved({{{{}, 0.5}}, {around}}, false);
    ASSERT_EQ(proofs.size(), 2u);
    EXPECT_EQ(proofs[0].spheres, 2u);
    EXPECT_EQ(proofs[0].triangles, 12u);
    EXPECT_EQ(proofs[0].pieces, certify(*finished.links[0].solid, Elements(std::vector<Element>{around})).pieces);
    EXPECT_THAT(told(std::vector{small}), HasSubstr("f: link 'base': the certificate does not hold for the numbers read back: 0.01"));
    EXPECT_THAT(told(good), IsEmpty()) << "a format may have another kind around an element";
    EXPECT_EQ(told({}), "f: link 'base' has no spheres in the written file");
    finished.links[0].elements.add(small);
    EXPECT_EQ(told(good), "f: link 'base' has 1 sphere in the written file, the model has 2 boxes");
    // A reader that takes spheres only: the link is not proved, others are.
    const auto some = proved({{{}, 0.5}}, true);
    ASSERT_EQ(some.size(), 1u);
    EXPECT_EQ(some[0].link, "tip");
    finished.links[0].elements = finished.links[0].elements.spheres();
    EXPECT_EQ(proved(good, true).size(), 2u);
    EXPECT_THAT(told(std::vector{around}), IsEmpty());
}

TEST_F(WrittenProofs, WhatWasNotProvedIsNotAskedFor) {
    works[0].report.measures.certified = false;
    const std::vector<WrittenProof> proofs =
        prove_spheres({{"base", {{{}, 0.1}}}, {"tip", {{{}, 2}}}}, finished, Guarantee::outer, Numbers::float64, "f");
    ASSERT_EQ(proofs.size(), 1u);
    EXPECT_EQ(proofs[0].link, "tip");
    works[1].report.measures.certified = false;
    EXPECT_THAT(prove_spheres({{"base", {{{}, 0.1}}}, {"tip", {{{}, 0.1}}}}, finished, Guarantee::outer, Numbers::float64, "f"),
                IsEmpty());
}

} // namespace
} // namespace foam
