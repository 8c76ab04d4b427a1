// The proof on what is read back from a file: the last thing between a wrong number and its reader.
#include "geometry/shapes.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/inner.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/written_proof.hpp>

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
    std::map<std::string, Approximation::Level> levels;
    for (const auto& [link, spheres] : read) {
        levels[link].spheres = spheres;
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
