// SPDX-License-Identifier: MIT
#pragma once

namespace spindrift::test
{

/// A scene whose wind is solved for round a house, and kept in a folder beside it.
inline constexpr const char* kHouse = R"(
[scene]
name = "house"
[domain]
min_m = [0, 0, 0]
max_m = [60, 40, 24]
[particles]
capacity = 2000
[wind]
source = "solve"
speed_m_s = 5
cell_m = 2
cache_folder = "kept"
[[emitter]]
shape = "box"
min_m = [1, 1, 1]
max_m = [10, 39, 20]
burst = 2000
[[box]]
min_m = [20, 14, 0]
max_m = [30, 26, 10]
[camera]
[[camera.key]]
eye_m = [0, 0, 10]
look_at_m = [50, 50, 10]
)";

}  // namespace spindrift::test
