// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <cmath>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/identify/fit/fit_summary.hpp"
#include "identify_docs.hpp"
#include "identify_parts.hpp"

namespace bathyal::python {
namespace {

py::list poses_to_list(const std::vector<Pose>& poses) {
  py::list list;
  for (const Pose& pose : poses) list.append(to_numpy(pose));
  return list;
}

void bind_fit_parts(py::module_& module) {
  py::class_<NullSpacePartner>(
      module, "Trade", "A parameter that takes part in an unobservable change of another one.")
      .def_readonly("name", &NullSpacePartner::name, "Of the parameter, as \"theta_3\".")
      .def_readonly("words", &NullSpacePartner::description, "Description, as \"theta of row 3\".")
      .def_readonly("factor", &NullSpacePartner::factor,
                    "Its change per unit of the other one, each in its own unit.")
      .def("__repr__", [](const NullSpacePartner& t) {
        return "Trade(" + t.name + ", " + to_text(t.factor) + ")";
      });
  py::class_<FitParameter>(module, "FitParameter", kFitParameterDoc)
      .def_readonly("name", &FitParameter::name, "As \"theta_3\".")
      .def_readonly("words", &FitParameter::description, "Description, as \"theta of row 3\".")
      .def_readonly("unit", &FitParameter::unit, "\"m\" or \"rad\".")
      .def_readonly("group", &FitParameter::group,
                    "Part of the arm, as \"row 3\", \"tool\" or \"base\".")
      .def_readonly("nominal", &FitParameter::nominal,
                    "In `unit`; of a tool or a base, where the search started.")
      .def_readonly("value", &FitParameter::value, "Estimate, in `unit`.")
      .def_readonly("std", &FitParameter::std,
                    "Standard deviation, in `unit`: 0 when fixed, inf when undetermined.")
      .def_property_readonly(
          "status", [](const FitParameter& p) { return std::string(to_text(p.status)); },
          "How it is determined; see the class.")
      .def_readonly("trades", &FitParameter::partners,
                    "Parameters that take part in an unobservable change of it.")
      .def("__repr__", [](const FitParameter& p) {
        return "FitParameter(" + p.name + "=" + to_text(p.value) + ", std=" + to_text(p.std) +
               ", " + std::string(to_text(p.status)) + ")";
      });
  py::class_<Outlier>(module, "Outlier", "A row that contradicts the others.")
      .def_readonly("row", &Outlier::row, "Row of the data, counted from 0.")
      .def_readonly("point", &Outlier::label, "Label of its point; -1 where there is none.")
      .def_readonly("distance", &Outlier::distance, "From its expected position [m].")
      .def_readonly(
          "fits", &Outlier::fits,
          "Label of the point that it agrees with, or None: labels were probably swapped.")
      .def("__repr__", [](const Outlier& o) {
        return "Outlier(row=" + std::to_string(o.row) + ", point=" + std::to_string(o.label) +
               ", distance=" + to_text(o.distance) +
               (o.fits ? ", fits=" + std::to_string(*o.fits) : "") + ")";
      });
}

void bind_fit(py::module_& module) {
  py::class_<ArmFit>(module, "ArmFit", kArmFitDoc)
      .def_readonly("arm", &ArmFit::arm, "Arm: identified, its base and tool set.")
      .def_property_readonly(
          "bases", [](const ArmFit& f) { return poses_to_list(f.bases); },
          "(4, 4) world_from_base of each station.")
      .def_property_readonly(
          "tools", [](const ArmFit& f) { return poses_to_list(f.tools); },
          "(4, 4) flange_from_tool of each tool.")
      .def_readonly("parameters", &ArmFit::parameters, "FitParameter of each unknown.")
      .def_property_readonly(
          "std",
          [](const ArmFit& f) {
            std::vector<double> std;
            for (const FitParameter& p : f.parameters) std.push_back(p.std);
            return to_numpy(std::move(std));
          },
          "(P,) of each parameter: 0 when fixed, inf when undetermined.")
      .def_property_readonly(
          "covariance", [](const ArmFit& f) { return to_numpy(RowMatrix(f.covariance)); },
          "(P, P) in the units of the parameters; 0 for undetermined ones.")
      .def_readonly("rms_before", &ArmFit::rms_before,
                    "Nominal rows with the best start of tool and base: √mean‖e‖² [m].")
      .def_readonly("rms_after", &ArmFit::rms_after, "√mean‖e‖² [m].")
      .def_readonly("rms_after_scaled", &ArmFit::rms_after_scaled,
                    "rms_after times given by estimated lengths: its value at the true scale [m].")
      .def_property_readonly(
          "point_rms_before", [](const ArmFit& f) { return to_numpy(f.point_rms_before); },
          "(n,) of each point, or station when tracked [m].")
      .def_property_readonly(
          "point_rms_after", [](const ArmFit& f) { return to_numpy(f.point_rms_after); },
          "(n,) [m]")
      .def_readonly("rotation_rms_before", &ArmFit::rotation_rms_before, "[rad]")
      .def_readonly("rotation_rms_after", &ArmFit::rotation_rms_after, "[rad]")
      .def_readonly("pairs_before", &ArmFit::pairs_before,
                    "J of Yukhimets, Gubankov (2023), eq 7 [m²].")
      .def_readonly("pairs_after", &ArmFit::pairs_after, "[m²]")
      .def_property_readonly(
          "history", [](const ArmFit& f) { return to_numpy(f.history); },
          "Sum of squares of the criterion at the start and after each step [m²].")
      .def_readonly("iterations", &ArmFit::iterations, "Accepted steps.")
      .def_readonly("converged", &ArmFit::converged,
                    "Whether the search ended before its limit of iterations.")
      .def_readonly("rank", &ArmFit::rank, "Of the data by all parameters, without priors.")
      .def_property_readonly(
          "singular_values", [](const ArmFit& f) { return to_numpy(f.singular_values); },
          "(P,) descending: millimetres at the tip per mm and mrad of a direction.")
      .def_readonly("unseen", &ArmFit::null_space, "Descriptions of the unobservable directions.")
      .def_readonly("noise", &ArmFit::noise, "Standard deviation per axis, estimated or given [m].")
      .def_readonly("rotation_noise", &ArmFit::rotation_noise, "[rad]")
      .def_readonly("degrees_of_freedom", &ArmFit::degrees_of_freedom,
                    "Position rows less those of points and parameters.")
      .def_readonly("scale_source", &ArmFit::scale_source, "What determines the scale of the arm.")
      .def_readonly("scale", &ArmFit::scale, "Estimated by nominal lengths.")
      .def_readonly("scale_std", &ArmFit::scale_std, "Relative standard deviation of `scale`.")
      .def_readonly("point_labels", &ArmFit::point_labels,
                    "(K,) label of each touched point, in the order of `points`.")
      .def_property_readonly(
          "points", [](const ArmFit& f) { return to_numpy(RowMatrix(f.points.transpose())); },
          "(n, 3) estimated positions of the touched points, world [m].")
      .def_property_readonly(
          "distances",
          [](const ArmFit& f) {
            py::dict dict;
            for (const DistanceComparison& d : f.distances) {
              dict[py::make_tuple(d.first, d.second)] = d.estimated;
            }
            return dict;
          },
          "Estimates of the known distances: {(label, label): m}.")
      .def_property_readonly(
          "residuals", [](const ArmFit& f) { return to_numpy(RowMatrix(f.residuals.transpose())); },
          "(N, 3) tip minus centroid, or minus the measured position, world [m].")
      .def_property_readonly(
          "residuals_before",
          [](const ArmFit& f) { return to_numpy(RowMatrix(f.residuals_before.transpose())); },
          "(N, 3) the same for `rms_before` [m].")
      .def_readonly("outliers", &ArmFit::outliers,
                    "Outlier of each row that contradicts the others.")
      .def_readonly("structure_p", &ArmFit::structure_p,
                    "Probability of residuals that depend on the joints this much by chance.")
      .def_readonly("warnings", &ArmFit::warnings, "Sentences; empty when all is well.")
      .def(
          "tip_covariance",
          [](const ArmFit& f, const ArrayLike& q, int num_threads) {
            const Rows rows = rows_argument("q", q, f.arm.size());
            std::vector<double> numbers;
            for (const Eigen::Matrix3d& c : tip_covariance(f, rows.table, num_threads)) {
              numbers.insert(numbers.end(), c.data(), c.data() + 9);  // symmetric
            }
            return to_numpy(std::move(numbers), rows.single, {3, 3});
          },
          py::arg("q"), py::kw_only(), py::arg("num_threads") = 0, kTipCovarianceDoc)
      .def(
          "tip_std",
          [](const ArmFit& f, const ArrayLike& q, int num_threads) -> OneOrArray<py::float_> {
            const Rows rows = rows_argument("q", q, f.arm.size());
            std::vector<double> numbers;
            for (const Eigen::Matrix3d& c : tip_covariance(f, rows.table, num_threads)) {
              numbers.push_back(std::sqrt(c.trace()));
            }
            if (rows.single) return py::float_(numbers.front());
            return to_numpy(std::move(numbers));
          },
          py::arg("q"), py::kw_only(), py::arg("num_threads") = 0, kTipStdDoc)
      .def("summary", py::overload_cast<const ArmFit&, bool>(&summarize), py::kw_only(),
           py::arg("warnings") = true,
           "One paragraph; ``warnings=False`` leaves the warnings to the caller.")
      .def("__repr__", [](const ArmFit& f) {
        return "ArmFit(rms_before=" + to_text(f.rms_before) +
               ", rms_after=" + to_text(f.rms_after) + ", rank=" + std::to_string(f.rank) + " of " +
               std::to_string(f.parameters.size()) + ")";
      });
}

}  // namespace

void bind_identify_fit(py::module_& module) {
  bind_fit_parts(module);
  bind_fit(module);
}

}  // namespace bathyal::python
