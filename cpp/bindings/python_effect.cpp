// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "arrays.hpp"
#include "bathyal/base/check.hpp"
#include "effects_docs.hpp"
#include "effects_parts.hpp"
#include "identify_parts.hpp"

namespace bathyal::python {
namespace {

/// The argument of a user's function. It owns its data: the function may keep it.
struct EffectRows {
  explicit EffectRows(const EffectData& data)
      : arm(py::cast(*data.arm)),
        q(to_numpy(data.q)),
        gravity(to_numpy(data.gravity)),
        order(to_numpy(data.order)),
        has_rotation(data.has_rotation),
        recording(data.recording) {
    for (const auto& [name, values] : data.covariates) {
      covariates[py::str(name)] =
          values.cols() == 1
              ? to_numpy(std::vector<double>(values.data(), values.data() + values.size()))
              : to_numpy(values);
    }
  }

  py::typing::Union<Arm> arm;
  py::array q, gravity, order;
  py::dict covariates;
  bool has_rotation, recording;
};

/// A function that may be released by any thread.
class Function {
 public:
  explicit Function(py::function function) : function_(std::move(function)) {}
  Function(const Function&) = delete;
  Function& operator=(const Function&) = delete;
  ~Function() {
    if (Py_IsInitialized() == 0) {
      function_.release();  // the interpreter is gone, and all that it held
      return;
    }
    const py::gil_scoped_acquire gil;
    function_ = py::function();
  }
  const py::function& get() const { return function_; }

 private:
  py::function function_;
};

/// "KeyError: 'depth' (line 12 of mine.py)": what was raised, and where.
std::string python_error_text(const py::error_already_set& error) {
  const auto text = [](const py::handle& object) { return py::str(object).cast<std::string>(); };
  std::string text_out = text(error.type().attr("__name__")) + ": " + text(error.value());
  py::object place = error.trace();
  if (!place || place.is_none()) return text_out;
  while (!place.attr("tb_next").is_none()) place = place.attr("tb_next");
  const std::string file = text(place.attr("tb_frame").attr("f_code").attr("co_filename"));
  return text_out + " (line " + text(place.attr("tb_lineno")) + " of " + file + ")";
}

/// Whether a covariate was recorded in every row and differs from row to row.
bool changes(const EffectData& data, const std::string& name) {
  const auto found = data.covariates.find(name);
  if (found == data.covariates.end()) return false;
  const RowMatrix& values = found->second;
  if (values.size() == 0 || !values.allFinite()) return false;
  return (values.rowwise() - values.row(0)).cwiseAbs().maxCoeff() > 0.0;
}

class PythonEffect final : public Effect {
 public:
  PythonEffect(UserEffect user, py::function function)
      : user_(std::move(user)), function_(std::move(function)) {}

  EffectInfo info() const override { return user_.info; }
  double period(const EffectVariant&) const override { return user_.period; }

  std::vector<EffectVariant> variants(const EffectData& data) const override {
    const bool seen = std::all_of(user_.info.needs.begin(), user_.info.needs.end(),
                                  [&](const std::string& name) { return changes(data, name); });
    std::vector<EffectVariant> variants;
    if (!seen) return variants;
    if (!user_.acts_by_joint()) {
      variants.push_back(variant_of(-1));
    } else if (user_.each_joint) {
      for (int j = 0; j < static_cast<int>(data.q.cols()); ++j) variants.push_back(variant_of(j));
    } else {
      for (const int joint : user_.joints) {
        if (joint >= static_cast<int>(data.q.cols())) {
          throw_argument(name(), "joints from 0 to " + std::to_string(data.q.cols() - 1),
                         std::to_string(joint));
        }
        variants.push_back(variant_of(joint));
      }
    }
    return variants;
  }

  std::vector<std::vector<Perturbation>> perturbations(const EffectVariant& variant,
                                                       const EffectData& data) const override {
    const py::gil_scoped_acquire gil;
    const Index parameters = static_cast<Index>(user_.parameters.size());
    const Index width = is_frame() ? 6 : 1;
    const RowMatrix numbers = call(variant, data, parameters, width);
    if (!checked_repeatable_) {
      checked_repeatable_ = true;
      if (call(variant, data, parameters, width) != numbers) {
        throw_argument(name(), "the same numbers whenever it is asked", "others the second time");
      }
    }
    std::vector<std::vector<Perturbation>> perturbations;
    for (Index p = 0; p < parameters; ++p) {
      perturbations.push_back({site_of(variant, *data.arm)});
      perturbations.back().front().values = numbers.middleCols(p * width, width);
      if (user_.site == UserSite::kLink) {
        to_row_frame(data.arm->links()[perturbations.back().front().index].row_from_link,
                     perturbations.back().front().values);
      }
    }
    return perturbations;
  }

 private:
  std::string name() const { return "effect " + user_.info.name; }
  bool is_frame() const {
    return user_.site != UserSite::kJoint && user_.site != UserSite::kLengths;
  }

  EffectVariant variant_of(int joint) const {
    EffectVariant variant;
    variant.effect = user_.info.name;
    variant.joint = joint;
    variant.parameters = user_.parameters;
    variant.alias_group =
        joint < 0 ? user_.info.name : user_.info.name + " " + std::to_string(joint);
    return variant;
  }

  Perturbation site_of(const EffectVariant& variant, const Arm& arm) const {
    switch (user_.site) {
      case UserSite::kJoint:
        return {PerturbationSite::kJoint, variant.joint, {}};
      case UserSite::kLink:
        return {PerturbationSite::kFrame, link_of(variant, arm), {}};
      case UserSite::kBase:
        return {PerturbationSite::kFrame, 0, {}};
      case UserSite::kTool:
        return {PerturbationSite::kFrame, static_cast<int>(arm.joints().size()) + 1, {}};
      case UserSite::kLengths:
        break;
    }
    return {PerturbationSite::kLength, 0, {}};
  }

  /// The link that the leading joint of the variant's coordinate moves.
  int link_of(const EffectVariant& variant, const Arm& arm) const {
    const auto leads = [&](const Joint& joint) { return joint.coordinate == variant.joint; };
    const auto leader = std::find_if(arm.joints().begin(), arm.joints().end(), leads);
    if (variant.joint < 0 || leader == arm.joints().end()) {
      throw_argument(name(), "a joint from 0 to " + std::to_string(arm.size() - 1),
                     std::to_string(variant.joint));
    }
    return static_cast<int>(leader - arm.joints().begin()) + 1;
  }

  /// Small shifts and turns (N, 6) of the frame of a link as those of the frame behind its row.
  static void to_row_frame(const Pose& row_from_link, RowMatrix& values) {
    const Eigen::Matrix3d rotation = row_from_link.linear();
    for (Index i = 0; i < values.rows(); ++i) {
      const Vec3 turn = rotation * values.row(i).tail<3>().transpose();
      const Vec3 shift = rotation * values.row(i).head<3>().transpose() -
                         turn.cross(Vec3(row_from_link.translation()));
      values.row(i) << shift.transpose(), turn.transpose();
    }
  }

  /// (N, parameters · width), the numbers of one parameter next to each other.
  RowMatrix call(const EffectVariant& variant, const EffectData& data, Index parameters,
                 Index width) const {
    py::object result;
    try {
      const py::object rows = py::cast(EffectRows(data));
      result = user_.acts_by_joint() ? function_.get()(rows, variant.joint) : function_.get()(rows);
    } catch (const py::error_already_set& error) {
      if (!error.matches(PyExc_Exception)) throw;  // an interrupt is the caller's own
      throw Error(name() + ": its function raised " + python_error_text(error));
    }
    return numbers_of(result, data.rows(), parameters, width);
  }

  RowMatrix numbers_of(const py::object& result, Index rows, Index parameters, Index width) const {
    const std::string tail = width == 1 ? "" : ", " + std::to_string(width);
    const std::string expected = "real numbers of shape (" + std::to_string(rows) + ", " +
                                 std::to_string(parameters) + tail + ")";
    const py::array array = array_argument(name(), result, expected);
    if (std::string_view("fiu").find(array.dtype().kind()) == std::string_view::npos) {
      throw_argument(name(), expected, "dtype " + py::str(array.dtype()).cast<std::string>());
    }
    std::vector<Index> wanted{rows};
    // Of one parameter its own dimension may be left out.
    const bool alone = parameters == 1 && array.ndim() == (width == 1 ? 1 : 2);
    if (!alone) wanted.push_back(parameters);
    if (width > 1) wanted.push_back(width);
    const std::vector<Index> shape(array.shape(), array.shape() + array.ndim());
    if (shape != wanted) {
      throw_argument(name(), expected, "shape " + py::str(array.attr("shape")).cast<std::string>());
    }
    const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>(array);
    RowMatrix table = Eigen::Map<const RowMatrix>(numbers.data(), rows, parameters * width);
    for (Index i = 0; i < table.size(); ++i) {
      const double value = table.data()[i];
      if (std::abs(value) <= kMaxPerturbation) continue;
      throw_argument(name(), "finite numbers within " + to_text(kMaxPerturbation),
                     to_text(value) + " in row " + std::to_string(i / table.cols()));
    }
    return table;
  }

  UserEffect user_;
  Function function_;
  mutable bool checked_repeatable_ = false;  ///< under the GIL
};

void check(const UserEffect& user) {
  if (user.info.name.empty()) throw_argument("name", "a name", "none");
  const std::string name = "effect " + user.info.name;
  if (user.parameters.empty()) throw_argument(name, "one parameter or more", "none");
  for (const EffectParameter& parameter : user.parameters) {
    check_positive(name + " scale of " + parameter.name, parameter.scale);
  }
  const bool joints = user.each_joint || !user.joints.empty();
  if (joints != user.acts_by_joint()) {
    throw_argument(name, "`joints` where its site is \"joint\" or \"link\", and there alone",
                   joints ? "joints of another site" : "none");
  }
  for (std::size_t i = 0; i < user.joints.size(); ++i) {
    const int joint = user.joints[i];
    if (joint < 0) throw_argument(name, "joints from 0", std::to_string(joint));
    const auto end = user.joints.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(user.joints.begin(), end, joint) != end) {
      throw_argument(name, "each joint once", std::to_string(joint) + " twice");
    }
  }
}

}  // namespace

std::shared_ptr<Effect> make_python_effect(UserEffect user, py::function function) {
  check(user);
  return std::make_shared<PythonEffect>(std::move(user), std::move(function));
}

void bind_effect_rows(py::module_& module) {
  py::class_<EffectRows>(module, "EffectRows", kEffectRowsDoc)
      .def_readonly("arm", &EffectRows::arm, "Arm: rows as far as they are known, and masses.")
      .def_readonly("q", &EffectRows::q, "(N, n) as recorded [rad] or [m].")
      .def_readonly("covariates", &EffectRows::covariates, "Name to (N,) or (N, k) array.")
      .def_readonly("gravity", &EffectRows::gravity, "(N, 3) [m/s²], in the arm's base frame.")
      .def_readonly("order", &EffectRows::order, "(N,) rows in the order in which they were taken.")
      .def_readonly("has_rotation", &EffectRows::has_rotation,
                    "Whether orientations were measured too.")
      .def_readonly("recording", &EffectRows::recording,
                    "Whether the rows follow each other in time; else each is a pose by itself.")
      .def("__len__", [](const EffectRows& rows) { return rows.q.shape(0); });
}

}  // namespace bathyal::python
