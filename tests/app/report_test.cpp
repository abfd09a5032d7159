// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/child_process.h"
#include "tests/app/command_fixture.h"

namespace spindrift::test
{

namespace
{

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count(const std::string& text, const std::string& word)
{
    std::size_t n = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
}

TEST_F(Command, ReportIsOnePageWithCurvesThatNeedsNothingElse)
{
    const std::string file = in_folder("report.html");
    const Finished done = run_command({"report", "-o", file, "--particles", "200", "--cells", "16"});
    ASSERT_EQ(done.exit_code, 0) << done.error;
    const std::string page = read(file);
    for (const char* id : {"advection-time", "advection-step", "advection-field", "solver"})
        EXPECT_THAT(page, HasSubstr(std::string("<svg id=\"") + id));
    for (const char* outside : {"src=", "href=", "url(", "@import", "<script", "<link", "nan", "inf,"})
        EXPECT_THAT(page, Not(HasSubstr(outside)));
    EXPECT_EQ(count(page, "<svg"), count(page, "</svg>"));
    EXPECT_GE(count(page, "class=\"frontier\""), 3U);
    // the default is marked; whether it is on the frontier is for the machine to say
    EXPECT_THAT(page, HasSubstr("circle class=\"default\""));
    EXPECT_THAT(page, HasSubstr("<tr class=\"default\">"));
    EXPECT_THAT(page, HasSubstr("<td>yes</td>"));
}

TEST_F(Command, ReportSaysAtOnceWhereItCannotWrite)
{
    const Finished done = run_command({"report", "-o", "/proc/none/report.html"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_THAT(done.error, HasSubstr("/proc/none"));
    EXPECT_EQ(run_command({"report"}).exit_code, 2);
}

}  // namespace

}  // namespace spindrift::test
