// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "arrays.hpp"
#include "bathyal/workspace/hull.hpp"

// What hulls and keep-outs share.

namespace bathyal::python {

/// (N,) from a function that fills N values and wants no lock.
template <class Fill>
py::array filled_flags(std::size_t count, const Fill& fill) {
  std::shared_ptr<bool[]> flags(new bool[count]);
  {
    const py::gil_scoped_release release;
    fill(std::span<bool>(flags.get(), count));
  }
  return read_only_array(flags.get(), {static_cast<py::ssize_t>(count)}, flags);
}

template <class Work>
py::array unlocked_values(const Work& work) {
  std::vector<double> values;
  {
    const py::gil_scoped_release release;
    values = work();
  }
  return to_numpy(std::move(values));
}

inline Hull make_hull(const TriangleMesh& mesh, int num_threads) {
  const py::gil_scoped_release release;
  return Hull(mesh.snapshot(), num_threads);
}

/// KeepOut; after Hull.
void bind_keepout(py::module_& module);

}  // namespace bathyal::python
