// SPDX-License-Identifier: MIT
#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/child_process.h"
#include "tests/app/command_fixture.h"

namespace spindrift::test
{

namespace
{

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class SortsCommand : public Command
{
  protected:
    static void expect_one_clear_line(const std::vector<std::string>& arguments, const std::string& about)
    {
        SCOPED_TRACE(testing::PrintToString(arguments));
        const Finished run = run_command(arguments);
        EXPECT_EQ(run.exit_code, 2) << run.error;
        EXPECT_EQ(std::count(run.error.begin(), run.error.end(), '\n'), 1) << run.error;
        EXPECT_THAT(run.error, HasSubstr(about));
        EXPECT_EQ(run.output, "");
    }
};

TEST_F(SortsCommand, MeasuresEverySortOnMadeUpKeys)
{
    const std::string csv = in_folder("t.csv"), file = in_folder("t.json");
    const Finished run =
        run_command({"sorts", "--backend", "cpu", "--sizes", "1K,777", "--patterns", "random,camera-sweep",
                     "--frames", "3", "--sort-passes", "4", "--out", csv, "--out", file});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    EXPECT_THAT(run.output,
                AllOf(HasSubstr("random, 1K pairs, 3 frames"), HasSubstr("camera-sweep, 777 pairs"),
                      HasSubstr("radix/16-bit"), HasSubstr("x floor")));
    constexpr std::size_t kSorts = 12;  // ten, and radix at 24 and 16 bits
    const json rows = json::parse(read(file)).at("rows");
    ASSERT_EQ(rows.size(), 4 * kSorts);
    const std::string text = read(csv);
    EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), 1 + rows.size());
    for (const json& row : rows)
    {
        SCOPED_TRACE(row.dump());
        EXPECT_EQ(row.at("frames"), 3);
        if (row.at("sort") != "none")
        {
            EXPECT_GT(row.at("median_ms"), 0);
        }
        EXPECT_GT(row.at("floor_ms"), 0);
        EXPECT_TRUE(row.at("image_relative_l2").is_null()) << "no scene, no picture";
        const bool passes = !row.at("passes_per_frame").is_null();
        if (passes)
        {
            EXPECT_EQ(row.at("passes_per_frame"), 4);
        }
        if (row.at("key_bits") == 32 && !passes && row.at("sort") != "none")
        {
            EXPECT_EQ(row.at("inversion_fraction"), 0);
        }
        if (passes && row.at("input") == "random")
        {
            EXPECT_GT(row.at("inversion_fraction"), 0.01);
        }
        EXPECT_LT(row.at("inversion_fraction"), 0.6);
    }
}

TEST_F(SortsCommand, TakesOnlyTheSortsThatAreAskedFor)
{
    const std::string file = in_folder("t.json");
    ASSERT_EQ(run_command({"sorts", "--sizes", "500", "--patterns", "equal", "--frames", "1", "--strategies",
                           "vqsort,odd-even-passes", "--out", file})
                  .exit_code,
              0);
    const json rows = json::parse(read(file)).at("rows");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].at("sort"), "vqsort");
    EXPECT_EQ(rows[1].at("sort"), "odd-even-passes");
}

TEST_F(SortsCommand, ShowsTheReportsTableBesideOurs)
{
    const Finished run = run_command({"sorts", "--table-4-1", "--frames", "1", "--backend", "cpu"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    EXPECT_THAT(run.output, AllOf(HasSubstr("| Pairs | Report: quick sort, CPU (s) | Ours: qsort, CPU (s) |"),
                                  HasSubstr("\n| 15K | 0.017000 | 0."), HasSubstr("\n| 2M | 3.350000 | "),
                                  HasSubstr(" 0.017319 | ")));
}

TEST_F(SortsCommand, AnswersWrongArgumentsInOneLine)
{
    expect_one_clear_line({"sorts", "--sizes", "many"}, "such as 15K,1M");
    expect_one_clear_line({"sorts", "--sizes", "0"}, "use 1 to 100M");
    expect_one_clear_line({"sorts", "--sizes", "101M"}, "use 1 to 100M");
    expect_one_clear_line({"sorts", "--sizes", "1K,2KK"}, "2KK");
    expect_one_clear_line({"sorts", "--patterns", "wild"}, "nearly-sorted");
    expect_one_clear_line({"sorts", "--strategies", "quick"}, "vqsort");
    expect_one_clear_line({"sorts", "--backend", "vulkan"}, "auto");
    expect_one_clear_line({"sorts", "--sort-passes", "0"}, "4096");
    expect_one_clear_line({"sorts", "--frames", "0"}, "--frames");
    expect_one_clear_line({"sorts", "--out", in_folder("t.txt")}, ".csv or .json");
    expect_one_clear_line({"sorts", "--out", in_folder("")}, in_folder(""));
    expect_one_clear_line({"sorts", "--table-4-1", "--sizes", "1K"}, "leave out");
    expect_one_clear_line({"sorts", "--particles", "1000"}, "--scene");
    expect_one_clear_line({"sorts", "--scene", "no-such-town"}, "no-such-town");
    expect_one_clear_line({"sorts", "extra"}, "extra");
}

TEST_F(SortsCommand, ASceneThatNamesASortOfAnotherBackendIsToldWhatIsThere)
{
    const std::string scene = small_scene();
    const Finished run =
        run_command({"run", scene, "--headless", "--steps", "1", "--backend", "cpu", "--sort", "cub-radix"});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.error, AllOf(HasSubstr("cub-radix"), HasSubstr("cpu backend"),
                                 HasSubstr("use auto, none, qsort"), HasSubstr("vqsort")));
    EXPECT_EQ(std::count(run.error.begin(), run.error.end(), '\n'), 1) << run.error;
}

}  // namespace

}  // namespace spindrift::test
