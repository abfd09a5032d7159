// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift::app
{

struct SortName
{
    std::string_view name;
    std::string_view about;  ///< one line
};

/// The sorts of a backend ("cpu" or "cuda"), in the order of its table; none of one that this build lacks.
std::vector<SortName> sorts_of(std::string_view backend);

/// The name in the backend's table that `asked` stands for: its own name, or what "auto" and "passes" mean
/// there. Throws Error that lists the sorts of the backend; never takes another.
std::string choose_sort(std::string_view backend, const std::string& asked);

// The device's part; other sources in builds with and without CUDA.
std::vector<SortName> cuda_sorts();
std::optional<std::string> find_cuda_sort(const std::string& asked);

}  // namespace spindrift::app
