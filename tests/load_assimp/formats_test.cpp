#include "fixture.hpp"
namespace foam::test {
namespace {
TEST_F(LoadAssimp, MissingFile) {
    EXPECT_NE(error_of(folder / "no.stl").find("there is no such file"), std::string::npos);
}
} // namespace
} // namespace foam::test
