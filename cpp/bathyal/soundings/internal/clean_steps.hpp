// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "bathyal/soundings/clean_cloud.hpp"

namespace bathyal::soundings {

/// A finite sounding and the row it came from.
struct Sounding {
  double x, y, z;
  std::int32_t row;
};

/// Soundings in canonical order: by x, y, z, row. Every step works on them in this order, so
/// nothing depends on the order of the rows.
using Soundings = std::vector<Sounding>;

/// One a sounding: whether it goes.
using Marks = std::vector<std::uint8_t>;

Marks mark_spikes(const Soundings& soundings, const CleanOptions& options);
Marks mark_outliers(const Soundings& soundings, const CleanOptions& options);
Marks mark_thinned(const Soundings& soundings, const CleanOptions& options);

}  // namespace bathyal::soundings
