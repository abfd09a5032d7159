// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace spindrift::scene
{

/// Every table and key of a scene file as Markdown, made from the descriptions by which scenes are read.
std::string schema_table();

}  // namespace spindrift::scene
