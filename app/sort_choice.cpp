// SPDX-License-Identifier: MIT
#include "app/sort_choice.h"

#include <fmt/format.h>

#include "core/error.h"
#include "cpu/sort/strategy.h"

namespace spindrift::app
{

namespace
{

std::optional<std::string> find_sort(std::string_view backend, const std::string& asked)
{
    if (backend == "cuda") return find_cuda_sort(asked);
    const cpu::SortStrategy* const found = cpu::find_sort_strategy(asked);
    return found == nullptr ? std::nullopt : std::optional(std::string(found->name));
}

}  // namespace

std::vector<SortName> sorts_of(std::string_view backend)
{
    if (backend == "cuda") return cuda_sorts();
    std::vector<SortName> sorts;
    for (const cpu::SortStrategy& strategy : cpu::sort_strategies())
        sorts.push_back({strategy.name, strategy.about});
    return sorts;
}

std::string choose_sort(std::string_view backend, const std::string& asked)
{
    if (const auto found = find_sort(backend, asked)) return *found;
    std::string names;
    for (const SortName& sort : sorts_of(backend)) names += fmt::format(", {}", sort.name);
    throw Error(
        fmt::format("sort = \"{}\": is no sort of the {} backend; use auto{}", asked, backend, names));
}

}  // namespace spindrift::app
