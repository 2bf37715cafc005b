// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "bathyal/base/page_allocator.hpp"
#include "bathyal/geometry/shared_array.hpp"

namespace bathyal::terrain {

/// The rows of `points` along a Hilbert curve over their horizontal bounding box, so that
/// neighbours in the list are neighbours on the bottom. Points in one cell of the curve follow a
/// finer curve of their own, or x, then y when they are few: the order depends on the points
/// and not on their rows. Rows of equal (x, y) are merged into the one of lowest z, then lowest
/// row. For finite points, |x| and |y| at most 1e75; the same for any number of threads.
PageVector<std::int32_t> hilbert_order(PointView points, int num_threads);

}  // namespace bathyal::terrain
