// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "arrays.hpp"
#include "bathyal/mission/tree.hpp"

namespace bathyal::python {

/// The number of a leaf, from its dict.
using LeafNumber = std::function<int(const py::dict& leaf)>;

/// A tree of dicts. \throw std::invalid_argument that names what is wrong
TreeNode tree_argument(const py::object& object, const LeafNumber& leaf);

}  // namespace bathyal::python
