// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bathyal/identify/verify.hpp"
#include "bindings.hpp"

namespace bathyal::python {

void bind_verify(py::module_& module) {
  py::class_<Verification, std::shared_ptr<Verification>>(
      module, "Verification",
      "How far positions that an arm predicts lie from measured ones: see `verify_arm`.")
      .def_property_readonly(
          "measured_from_predicted",
          [](const Verification& v) { return to_numpy(v.measured_from_predicted); },
          "(4, 4) the alignment.")
      .def_readonly("rms_before", &Verification::rms_before,
                    "√mean‖e‖² with the centroids removed only [m].")
      .def_readonly("rms_after", &Verification::rms_after, "√mean‖e‖² aligned [m].")
      .def_property_readonly(
          "deviation",
          [](const std::shared_ptr<Verification>& v) {
            return read_only_array(v->deviation.data(),
                                   {static_cast<py::ssize_t>(v->deviation.size())}, v);
          },
          "(N,) distance of each prediction from its measured position, aligned [m].")
      .def_property_readonly(
          "residual",
          [](const std::shared_ptr<Verification>& v) {
            return read_only_array(v->residual.data(),
                                   {static_cast<py::ssize_t>(v->residual.rows()), 3}, v);
          },
          "(N, 3) measured less predicted, aligned, in the measured frame [m].")
      .def_property_readonly(
          "pairs",
          [](const std::shared_ptr<Verification>& v) {
            return read_only_array(v->pairs.data(), {static_cast<py::ssize_t>(v->pairs.size())}, v);
          },
          "(N,) row of the measured positions that belongs to each prediction.")
      .def("__repr__", [](const Verification& v) {
        return py::str("Verification({} positions, rms {:.3g} mm, before alignment {:.3g} mm)")
            .format(v.deviation.size(), 1e3 * v.rms_after, 1e3 * v.rms_before);
      });

  module.def(
      "verify_positions",
      [](const ArrayLike& predicted, const ArrayLike& measured, const std::vector<Index>& pairs) {
        const Points from = points_argument("predicted", predicted);
        const Points onto = points_argument("positions", measured);
        return std::make_shared<Verification>(verify_positions(from.view(), onto.view(), pairs));
      },
      py::arg("predicted"), py::arg("positions"), py::kw_only(),
      py::arg("pairs") = std::vector<Index>{},
      "The comparison behind `verify_arm`, of positions (N, 3) [m].");
}

}  // namespace bathyal::python
