// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "scene/scene.h"
#include "scene/schema_table.h"

namespace spindrift::scene
{
namespace
{

const std::filesystem::path kPage = std::filesystem::path(SPINDRIFT_SOURCE_DIR) / "docs" / "scenes.md";
constexpr std::string_view kBegin =
    "<!-- keys: written by test_read_scene with SPINDRIFT_UPDATE_DOCS=1 -->\n";
constexpr std::string_view kEnd = "<!-- end of keys -->\n";

std::string text_of(const std::filesystem::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

TEST(ScenesPage, HoldsEveryKeyAsItIsRead)
{
    std::string page = text_of(kPage);
    const std::size_t begin = page.find(kBegin);
    const std::size_t end = page.find(kEnd);
    ASSERT_NE(begin, std::string::npos);
    ASSERT_NE(end, std::string::npos);
    const std::size_t first = begin + kBegin.size();
    if (std::getenv("SPINDRIFT_UPDATE_DOCS"))
        std::ofstream(kPage) << page.replace(first, end - first, schema_table());
    else
        EXPECT_EQ(page.substr(first, end - first), schema_table())
            << "run test_read_scene with SPINDRIFT_UPDATE_DOCS=1";
}

TEST(ScenesPage, CompleteExampleIsAScene)
{
    const std::string page = text_of(kPage);
    const std::size_t fence = page.find("```toml\n");
    ASSERT_NE(fence, std::string::npos);
    const std::size_t first = fence + std::string_view("```toml\n").size();
    EXPECT_NO_THROW(parse_scene(page.substr(first, page.find("```", first) - first), "docs/scenes.md"));
}

}  // namespace
}  // namespace spindrift::scene
