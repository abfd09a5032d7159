// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace spindrift::scene
{

/// The known name that `name` is most likely a slip of, by edits (insert, remove, replace, swap of
/// neighbours); empty when nothing is near: more than a third of the letters and more than two differ.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

/// "a, b or c".
std::string listed(std::span<const std::string_view> names);

}  // namespace spindrift::scene
