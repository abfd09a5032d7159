// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/cell_order.h"
#include "core/flake.h"

namespace spindrift::cpu
{

/// Puts the living flakes of the slots [0, used) in the order of their wind cells, in place, without holes;
/// those of one cell keep their order. The draw list's memory is what it works in: the list is lost. `ranks`,
/// unless it is null, go with them; slots that fall free have kNoRank.
void reorder_by_cell(const CellOrder& order, std::size_t used, std::size_t alive, const DrawListView& list,
                     std::uint32_t* ranks);

/// Puts flakes of equal keys in order of emission, after a sort of n pairs.
void order_ties(std::uint64_t* pairs, std::size_t n, const std::uint32_t* id, std::uint32_t next_id);

}  // namespace spindrift::cpu
