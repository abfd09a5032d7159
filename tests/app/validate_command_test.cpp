// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/app/child_process.h"
#include "tests/app/command_fixture.h"

namespace spindrift::test
{

namespace
{

using ::testing::HasSubstr;

TEST_F(Command, ValidatePrintsATableAndSucceeds)
{
    const Finished done = run_command({"validate", "--case", "settling", "--particles", "100"});
    EXPECT_EQ(done.exit_code, 0) << done.error;
    for (const char* word :
         {"settling", "metric", "measured", "truth", "noise", "pass", "12 checks", "0 failed"})
        EXPECT_THAT(done.output, HasSubstr(word));
}

TEST_F(Command, ValidateFailsWhereAMeasuredValueIsOff)
{
    // one release whose concentrations are ten times too high
    write("prairie_grass_neutral_arcs.csv",
          "run,Q_g_s,hs_m,zr_m,ustar_m_s,L_m,arc_m,Cy_over_Q_s_m2,sigma_y_m,Cmax_over_Q_s_m3\n"
          "21,50.9,0.46,1.5,0.38,172.0,50,6.2e-01,4.2,6e-03\n"
          "21,50.9,0.46,1.5,0.38,172.0,100,3.7e-01,7.2,2e-03\n"
          "21,50.9,0.46,1.5,0.38,172.0,200,2.0e-01,12.6,6e-04\n");
    const Finished done = run_command({"validate", "--case", "prairie-grass", "--particles", "200", "--dt",
                                       "0.1", "--data", in_folder(""), "--json"});
    EXPECT_EQ(done.exit_code, 1) << done.error;
    const auto json = nlohmann::json::parse(done.output);
    EXPECT_FALSE(json["pass"].get<bool>());
    EXPECT_EQ(json["cases"][0]["case"], "prairie-grass");
    EXPECT_FALSE(json["cases"][0]["checks"][0]["pass"].get<bool>());
}

TEST_F(Command, ValidateAnswersWhatItCannotDo)
{
    const auto refused = [](const std::vector<std::string>& arguments, const char* word)
    {
        const Finished done = run_command(arguments);
        EXPECT_EQ(done.exit_code, 2);
        EXPECT_THAT(done.error, HasSubstr(word));
    };
    refused({"validate", "--case", "nothing"}, "use some of ornstein-uhlenbeck");
    refused({"validate", "--case", "solver-order", "--dt", "0.1"}, "--dt");
    refused({"validate", "--case", "solver-order", "--particles", "1000"}, "--particles");
    refused({"validate", "--dt", "100"}, "--dt");
    write("prairie_grass_neutral_arcs.csv", "run\nnonsense\n");
    refused({"validate", "--case", "prairie-grass", "--data", in_folder("")},
            "prairie_grass_neutral_arcs.csv:2");
}

}  // namespace

}  // namespace spindrift::test
