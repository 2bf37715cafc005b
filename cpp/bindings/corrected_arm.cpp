// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/compensation/corrected_arm.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arm_class.hpp"
#include "arm_inverse.hpp"
#include "bathyal/base/error.hpp"
#include "effects_docs.hpp"
#include "hooks.hpp"
#include "identify_parts.hpp"

namespace bathyal::python {
namespace {

// Arguments -------------------------------------------------------------------------------------

/// A number for all rows, one a row as (N,), or (N, k); of what has several columns also one row
/// as (k,).
RowMatrix covariate_argument(const std::string& name, const py::object& object, Index columns) {
  const std::string argument = "covariates " + name;
  const py::array array =
      array_argument(argument, object, "real numbers of shape (), (N,) or (N, k)");
  if (array.ndim() == 0) return covariate_argument(name, array.attr("reshape")(1), 1);
  if (array.ndim() == 1) {
    const Values values = values_argument(argument, array);
    if (columns > 1) return values.view().transpose();
    return values.view();
  }
  return table_argument(argument, array, array.ndim() == 2 ? array.shape(1) : 1);
}

Covariates query_covariates(const CorrectedArm& model, const py::object& object) {
  Covariates covariates;
  if (object.is_none()) return covariates;
  if (!py::isinstance<py::dict>(object)) {
    throw_argument("covariates", "a dict of name to numbers",
                   py::str(py::type::of(object).attr("__name__")).cast<std::string>());
  }
  for (const auto& [key, value] : object.cast<py::dict>()) {
    const std::string name = py::str(key);
    const auto range = model.support().covariates.find(name);
    const Index columns = name == "gravity"                           ? 3
                          : range == model.support().covariates.end() ? 1
                                                                      : range->second.low.size();
    covariates[name] = covariate_argument(name, py::reinterpret_borrow<py::object>(value), columns);
  }
  return covariates;
}

Support::Range range_argument(const std::string& name, const py::object& object, Index columns) {
  const py::array array = array_argument(name, object, "least and greatest, of shape (2, k)");
  if (array.ndim() != 2 || array.shape(0) != 2) {
    throw_argument(name, "least and greatest, of shape (2, k)",
                   py::repr(object).cast<std::string>());
  }
  const RowMatrix table = table_argument(name, array, columns > 0 ? columns : array.shape(1));
  return {table.row(0).transpose(), table.row(1).transpose()};
}

std::vector<std::vector<Support::Gap>> gaps_argument(const py::sequence& gaps) {
  std::vector<std::vector<Support::Gap>> out;
  for (const py::handle& of_joint : gaps) {
    out.emplace_back();
    const std::string name = "gaps of joint " + std::to_string(out.size());
    const py::array array = array_argument(name, py::reinterpret_borrow<py::object>(of_joint),
                                           "real numbers of shape (N, 2)");
    if (array.size() == 0) continue;
    const RowMatrix table = table_argument(name, array, 2);
    for (const auto& row : table.rowwise()) out.back().push_back({row[0], row[1]});
  }
  return out;
}

Support make_support(const ArrayLike& joints, const py::sequence& gaps,
                     const OptionalArray& gravity, const py::dict& covariates,
                     const OptionalArray& sessions) {
  Support support = support_of(RowMatrix::Zero(1, 1), {});
  support.joints = range_argument("joints", joints, 0);
  support.gaps = gaps_argument(gaps);
  if (!gravity.is_none()) support.gravity = range_argument("gravity", gravity, 3);
  for (const auto& [key, value] : covariates) {
    const std::string name = py::str(key);
    support.covariates[name] =
        range_argument("covariates " + name, py::reinterpret_borrow<py::object>(value), 0);
  }
  if (!sessions.is_none()) {
    const Values values = values_argument("sessions", sessions);
    support.sessions.assign(values.data(), values.data() + values.rows());
  }
  support.check(support.joints.low.size());
  return support;
}

using Known = py::typing::Union<Touches, Tracked, Support>;

Support support_argument(const py::object& data) {
  const auto of = [](const auto& known) { return support_of(known.q, known.covariates); };
  if (py::isinstance<Support>(data)) return data.cast<Support>();
  if (py::isinstance<Touches>(data)) return of(data.cast<const Touches&>());
  if (py::isinstance<Tracked>(data)) return of(data.cast<const Tracked&>());
  throw_argument("data", "Touches, Tracked or Support",
                 py::str(py::type::of(data).attr("__name__")).cast<std::string>());
}

// Results ---------------------------------------------------------------------------------------

py::array range_to_numpy(const Support::Range& range) {
  RowMatrix table(2, range.low.size());
  table << range.low.transpose(), range.high.transpose();
  return to_numpy(table);
}

py::array mask_to_numpy(const SupportMask& mask) {
  py::array_t<bool> array({mask.rows(), mask.cols()});
  std::copy(mask.data(), mask.data() + mask.size(), array.mutable_data());
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array rows_to_numpy(const SupportMask& mask) {
  py::array_t<bool> array(mask.rows());
  for (Index i = 0; i < mask.rows(); ++i) array.mutable_at(i) = mask.row(i).all();
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::list gaps_to_python(const std::vector<std::vector<Support::Gap>>& gaps) {
  py::list out;
  for (const std::vector<Support::Gap>& of_joint : gaps) {
    RowMatrix table(static_cast<Index>(of_joint.size()), 2);
    for (std::size_t i = 0; i < of_joint.size(); ++i) {
      table.row(static_cast<Index>(i)) << of_joint[i].low, of_joint[i].high;
    }
    out.append(to_numpy(table));
  }
  return out;
}

/// (N, effects) the numbers of EffectUse, as the warning of the package counts them.
py::array uses_to_numpy(const EffectUses& uses) {
  py::array_t<std::int8_t> array({uses.rows(), uses.cols()});
  std::transform(uses.data(), uses.data() + uses.size(), array.mutable_data(),
                 [](EffectUse use) { return static_cast<std::int8_t>(use); });
  return array;
}

/// One warning for a call in which effects were extrapolated, held or omitted, reported at the line
/// of the call.
void warn_of_support(const CorrectedArm& model, const RowMatrix& q, const Covariates& covariates,
                     const EffectUses& uses) {
  if (within(uses).all()) return;
  py::dict out;
  for (const auto& [name, values] : covariates) out[py::str(name)] = to_numpy(values);
  hook(Hook::kWarnOfSupport)(py::cast(&model, py::return_value_policy::reference), to_numpy(q), out,
                             uses_to_numpy(uses));
}

// Methods ---------------------------------------------------------------------------------------

py::array forward_corrected(const CorrectedArm& model, const ArrayLike& q,
                            const OptionalCovariates& covariates, bool links, int num_threads) {
  const Rows rows = rows_argument("q", q, model.size());
  const Covariates given = query_covariates(model, covariates);
  CorrectedPoses found;
  {
    const py::gil_scoped_release release;
    found = links ? model.forward_links(view_of(rows), given, num_threads)
                  : model.forward(view_of(rows), given, num_threads);
  }
  warn_of_support(model, rows.table, given, found.uses);
  std::vector<py::ssize_t> tail{4, 4};
  if (links) tail.insert(tail.begin(), static_cast<py::ssize_t>(model.arm().links().size()));
  return to_numpy(std::move(found.poses), rows.single, std::move(tail));
}

py::array jacobian_corrected(const CorrectedArm& model, const ArrayLike& q,
                             const OptionalCovariates& covariates, const std::string& frame,
                             int num_threads) {
  const Rows rows = rows_argument("q", q, model.size());
  const Covariates given = query_covariates(model, covariates);
  const TipFrame axes = enum_argument("frame", frame, tip_frame_names());
  CorrectedJacobians found;
  {
    const py::gil_scoped_release release;
    found = model.jacobian(view_of(rows), given, axes, num_threads);
  }
  warn_of_support(model, rows.table, given, found.uses);
  return to_numpy(std::move(found.jacobians), rows.single, {6, model.size()});
}

InverseAnswer inverse_corrected(const CorrectedArm& model, const ArrayLike& poses,
                                const OptionalArray& start, const OptionalCovariates& covariates,
                                const InverseOptions& options) {
  const Targets targets = targets_argument(poses, options.task);
  const Rows starts = start.is_none() ? Rows{} : rows_argument("start", start, model.size());
  const Covariates given = query_covariates(model, covariates);
  CorrectedInverse found;
  {
    const py::gil_scoped_release release;
    const JointView view(starts.table.data(), start.is_none() ? 0 : starts.table.rows(),
                         model.size());
    found = model.inverse(targets.poses, view, given, options);
  }
  warn_of_support(model, found.result.q, given, found.uses);
  return {std::move(found.result), targets.single};
}

/// The answer of `ask(rows, covariates)` without the GIL; `make` turns it into Python's, of which a
/// single pose has the only element.
template <class Ask, class Make>
py::object of_rows(const CorrectedArm& model, const ArrayLike& q,
                   const OptionalCovariates& covariates, const Ask& ask, const Make& make) {
  const Rows rows = rows_argument("q", q, model.size());
  const Covariates given = query_covariates(model, covariates);
  const auto answer = [&] {
    const py::gil_scoped_release release;
    return ask(view_of(rows), given);
  }();
  const py::object out = make(answer);
  return rows.single ? out[py::int_(0)] : out;
}

void add_support_methods(py::class_<CorrectedArm>& cls) {
  cls.def(
         "in_support",
         [](const CorrectedArm& model, const ArrayLike& q,
            const OptionalCovariates& covariates) -> OneOrArray<py::bool_> {
           return of_rows(
               model, q, covariates,
               [&](JointView at, const Covariates& c) { return within(model.effect_uses(at, c)); },
               &rows_to_numpy);
         },
         py::arg("q"), py::kw_only(), py::arg("covariates") = py::none(), kInSupportDoc)
      .def(
          "effects_in_support",
          [](const CorrectedArm& model, const ArrayLike& q,
             const OptionalCovariates& covariates) -> py::array {
            return of_rows(
                model, q, covariates,
                [&](JointView at, const Covariates& c) { return within(model.effect_uses(at, c)); },
                &mask_to_numpy);
          },
          py::arg("q"), py::kw_only(), py::arg("covariates") = py::none(), kEffectsInSupportDoc)
      .def(
          "support_reasons",
          [](const CorrectedArm& model, const ArrayLike& q, const OptionalCovariates& covariates)
              -> py::typing::Union<py::typing::List<py::str>, py::str> {
            return of_rows(
                model, q, covariates,
                [&](JointView at, const Covariates& c) { return model.support_reasons(at, c); },
                [](const std::vector<std::string>& reasons) { return py::cast(reasons); });
          },
          py::arg("q"), py::kw_only(), py::arg("covariates") = py::none(), kSupportReasonsDoc);
}

std::string model_repr(const CorrectedArm& model) {
  const Arm& arm = model.arm();
  std::string text = "CorrectedArm(" + (arm.name().empty() ? "" : "\"" + arm.name() + "\", ");
  text += std::to_string(arm.size()) + (arm.size() == 1 ? " joint" : " joints");
  for (const FoundEffect& found : model.effects()) text += ", " + describe(found);
  return text + ")";
}

// Classes ---------------------------------------------------------------------------------------

void bind_support(py::module_& module) {
  py::class_<Support>(module, "Support", kSupportDoc)
      .def(py::init(&make_support), py::arg("joints"), py::kw_only(), py::arg("gaps") = py::tuple(),
           py::arg("gravity") = py::none(), py::arg("covariates") = py::dict(),
           py::arg("sessions") = py::none())
      .def_property_readonly(
          "joints", [](const Support& s) { return range_to_numpy(s.joints); },
          "(2, n) least and greatest of each coordinate [rad] or [m].")
      .def_property_readonly(
          "gaps", [](const Support& s) { return gaps_to_python(s.gaps); },
          "Of each coordinate (g, 2) from and to: stretches within its range without data, wider "
          "than a 200th of it; an empty list where unknown.")
      .def_property_readonly(
          "gravity", [](const Support& s) { return range_to_numpy(s.gravity); }, "(2, 3) [m/s²]")
      .def_property_readonly(
          "covariates",
          [](const Support& s) {
            py::dict dict;
            for (const auto& [name, range] : s.covariates)
              dict[py::str(name)] = range_to_numpy(range);
            return dict;
          },
          "Name to (2, k): all but `session` and `gravity`.")
      .def_property_readonly(
          "sessions", [](const Support& s) { return to_numpy(s.sessions); },
          "(s,) of the training data.")
      .def("__repr__", [](const Support& s) {
        return "Support(" + std::to_string(s.joints.low.size()) + " joints, " +
               std::to_string(s.covariates.size()) + " covariates, " +
               std::to_string(s.sessions.size()) + " sessions)";
      });
}

/// What a corrected arm has of its rigid part.
void add_rigid_part(py::class_<CorrectedArm>& cls) {
  cls.def_property_readonly(
         "arm", [](const CorrectedArm& m) { return m.arm(); },
         "Arm: a copy of the rigid part, for uses without effects (its .to_urdf()).")
      .def_property_readonly(
          "name", [](const CorrectedArm& m) { return m.arm().name(); }, "Of the rigid arm.")
      .def_property_readonly(
          "source", [](const CorrectedArm& m) { return m.arm().source(); },
          "Where the numbers come from.")
      .def_property_readonly("size", &CorrectedArm::size,
                             "Number of coordinates n, the width of every q.")
      .def_property(
          "base", [](const CorrectedArm& m) { return to_numpy(m.arm().base()); },
          [](CorrectedArm& m, const OptionalArray& pose) {
            m.set_base(pose_argument("base", pose));
          },
          "(4, 4) world_from_base; may be set, None is the identity.")
      .def_property(
          "tool", [](const CorrectedArm& m) { return to_numpy(m.arm().tool()); },
          [](CorrectedArm& m, const OptionalArray& pose) {
            m.set_tool(pose_argument("tool", pose));
          },
          "(4, 4) flange_from_tool; may be set, None is the identity.");
}

void add_inverse(py::class_<CorrectedArm>& cls) {
  const InverseOptions defaults;
  cls.def(
      "inverse",
      [](const CorrectedArm& model, const ArrayLike& poses, const OptionalArray& start,
         const OptionalCovariates& covariates, const std::string& task, const ArrayLike& axis,
         std::optional<double> position_tolerance, std::optional<double> angle_tolerance,
         int max_iterations, int max_starts, int candidates, std::optional<int> centering_steps,
         std::uint64_t seed, int num_threads) {
        InverseOptions options;
        options.task = enum_argument("task", task, task_names());
        options.axis = vector_argument("axis", axis);
        options.position_tolerance = position_tolerance;
        options.angle_tolerance = angle_tolerance;
        options.max_iterations = max_iterations;
        options.max_starts = max_starts;
        options.candidates = candidates;
        options.centering_steps = centering_steps;
        options.seed = seed;
        options.num_threads = num_threads;
        return inverse_corrected(model, poses, start, covariates, options);
      },
      py::arg("poses"), py::arg("start") = py::none(), py::kw_only(),
      py::arg("covariates") = py::none(), py::arg("task") = enum_name(defaults.task, task_names()),
      py::arg("axis") = py::make_tuple(defaults.axis.x(), defaults.axis.y(), defaults.axis.z()),
      py::arg("position_tolerance") = defaults.position_tolerance,
      py::arg("angle_tolerance") = defaults.angle_tolerance,
      py::arg("max_iterations") = defaults.max_iterations,
      py::arg("max_starts") = defaults.max_starts, py::arg("candidates") = defaults.candidates,
      py::arg("centering_steps") = defaults.centering_steps, py::arg("seed") = defaults.seed,
      py::arg("num_threads") = defaults.num_threads, kCorrectedInverseDoc);
}

}  // namespace

void bind_corrected_arm(py::module_& module) {
  bind_support(module);
  py::class_<CorrectedArm> cls(module, "CorrectedArm", kCorrectedArmDoc);
  cls.def(py::init([](const Arm& arm, std::vector<FoundEffect> effects, const Known& data) {
            return CorrectedArm(arm, std::move(effects), support_argument(data));
          }),
          py::arg("arm"), py::arg("effects"), py::arg("data"))
      .def_property_readonly("effects", &CorrectedArm::effects, "List of FoundEffect.")
      .def_property_readonly("support", &CorrectedArm::support, "The region that the data cover.")
      .def_property_readonly(
          "gaps", [](const CorrectedArm& m) { return gaps_to_python(m.gaps()); },
          "Of each coordinate (g, 2) from and to: gaps of the support in which a wave or curve "
          "along "
          "it is held.")
      .def("forward", &forward_corrected, py::arg("q"), py::kw_only(),
           py::arg("covariates") = py::none(), py::arg("links") = false, py::arg("num_threads") = 0,
           kCorrectedForwardDoc)
      .def("jacobian", &jacobian_corrected, py::arg("q"), py::kw_only(),
           py::arg("covariates") = py::none(),
           py::arg("frame") = enum_name(TipFrame::kWorld, tip_frame_names()),
           py::arg("num_threads") = 0, kCorrectedJacobianDoc)
      .def(
          "copy", [](const CorrectedArm& m) { return m; },
          "An independent copy, with its own base and tool.")
      .def("__copy__", [](const CorrectedArm& m) { return m; })
      .def(
          "__deepcopy__", [](const CorrectedArm& m, const py::dict&) { return m; }, py::arg("memo"))
      .def("__repr__", &model_repr);
  add_support_methods(cls);
  add_rigid_part(cls);
  add_inverse(cls);
}

}  // namespace bathyal::python
