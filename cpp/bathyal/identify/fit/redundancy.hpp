// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bathyal/estimation/rank.hpp"
#include "bathyal/identify/model/arm_parameters.hpp"

namespace bathyal {

/// A column that no measurement of this kind can ever tell from the base, the tool and the columns
/// that are kept: it stays at its nominal value, and loses nothing by it.
struct GaugeColumn {
  int column = 0;
  std::vector<Trade> trades;  ///< what can do the same, and how much of it per unit
};

/// Found by trial, not by rule: the tip's derivatives over random poses of an arm with rows like
/// this one's but no special angles or lengths. Which of the columns that do the same is kept, the
/// arm as it stands decides: together those see all that can be seen of it there, too. With
/// `base_known` the base takes nothing over, and columns that are `fixed` neither take over nor are
/// gauge. For use inside the room.
std::vector<GaugeColumn> find_gauge(const ArmColumns& columns, const Measurement& measurement,
                                    const ColumnChoice& choice, bool base_known,
                                    const std::vector<int>& fixed);

}  // namespace bathyal
