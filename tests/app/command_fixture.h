// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace spindrift::test
{

/// A folder of its own for each test, gone afterwards.
class Command : public testing::Test
{
  protected:
    Command()
    {
        std::string name = (std::filesystem::temp_directory_path() / "spindrift-XXXXXX").string();
        folder_ = mkdtemp(name.data());
    }
    ~Command() override
    {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }

    std::string in_folder(const std::string& name) const { return (folder_ / name).string(); }

    std::string write(const std::string& name, const std::string& text) const
    {
        std::ofstream(in_folder(name)) << text;
        return in_folder(name);
    }

    static std::string read(const std::string& file)
    {
        std::ostringstream text;
        text << std::ifstream(file, std::ios::binary).rdbuf();
        return text.str();
    }

    std::size_t files() const
    {
        std::size_t n = 0;
        for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++n;
        return n;
    }

    /// A gusty box with obstacles and 20 000 flakes: every part of a step has work.
    std::string small_scene() const { return write("small.toml", kSmallScene); }

  private:
    static constexpr const char* kSmallScene = R"(
[scene]
name = "small"
about = "a scene for tests"
seed = 7
step_s = 0.05
[domain]
min_m = [0, 0, 0]
max_m = [40, 40, 20]
on_leave = "respawn"
[particles]
capacity = 20000
[wind]
source = "log"
speed_m_s = 6
reference_height_m = 10
roughness_m = 0.1
from_direction_deg = 250
[[emitter]]
shape = "box"
min_m = [1, 1, 1]
max_m = [39, 39, 19]
burst = 15000
rate_per_s = 700.5
[[box]]
min_m = [15, 15, 0]
max_m = [22, 24, 9]
[voxels]
size_m = 1
[camera]
[[camera.key]]
time_s = 0
eye_m = [20, -20, 8]
look_at_m = [20, 20, 6]
[render]
width_px = 96
height_px = 64
frames = 8
frames_per_s = 20
)";

    std::filesystem::path folder_;
};

}  // namespace spindrift::test
