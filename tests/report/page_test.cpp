// Pages that need no other file.
#include "fixture.hpp"
#include "report/src/embedded_resources.hpp"
#include "report/src/sections.hpp"

namespace foam::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

TEST(Page, OnlyItsOwnScriptsRunAndNothingIsLoaded) {
    // SHA-256 of "1" and "2", as `printf 1 | openssl sha256 -binary | base64` says.
    const EmbeddedText one{"1", "6b86b273ff34fce19d6b804eff5a3f5747ada4eaa22f1d49c01e52ddb7875b4b"};
    const EmbeddedText two{"2", "d4735e3a265e16eee03f59718b9b5d03019c07d8b6c51f90da3a666eec13ab35"};
    const std::string page = report::page("t", "<p>body</p>", {one, two});
    EXPECT_THAT(page, HasSubstr("content=\"default-src 'none'; img-src data:; style-src 'sha256-"));
    EXPECT_THAT(page, HasSubstr("script-src 'sha256-a4ayc/80/OGda4BO/1o/V0etpOqiLx1JwB5S3beHW0s=' "
                                "'sha256-1HNeOiZeFu7gP1lxi5tdAwGcB9i2xR+Q2jpmbuwTqzU='; base-uri 'none'"));
    EXPECT_THAT(page, EndsWith("<p>body</p><script>1</script>\n<script>2</script>\n</body>\n</html>\n"));
}

TEST(Page, ResourcesEndNoElement) {
    for (const auto* resource : {&resources::page_js, &resources::renderer_js, &resources::viewer_js}) {
        EXPECT_EQ(resource->text.find("</script"), std::string_view::npos);
        EXPECT_EQ(resource->sha256.size(), 64u);
    }
    EXPECT_EQ(resources::page_css.text.find("</style"), std::string_view::npos);
}

} // namespace
} // namespace foam::test
