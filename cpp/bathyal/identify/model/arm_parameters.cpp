// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/model/arm_parameters.hpp"

#include <array>
#include <cmath>

#include "bathyal/arm/row_frames.hpp"
#include "bathyal/geometry/rotation_vector.hpp"

namespace bathyal {
namespace {

/// From the frame behind joint `k` to the one before the next joint that moves.
Eigen::Matrix3d turn_to_next_axis(const Arm& arm, std::size_t k) {
  const std::vector<Joint>& joints = arm.joints();
  Eigen::Matrix3d turn = row_pose(joints[k].row, joints[k].type, 0.0).linear();
  for (std::size_t i = k + 1; i < joints.size() && joints[i].type == JointType::kFixed; ++i) {
    turn = turn * row_pose(joints[i].row, joints[i].type, 0.0).linear();
  }
  return turn;
}

bool has_next_axis(const Arm& arm, std::size_t k) {
  for (std::size_t i = k + 1; i < arm.joints().size(); ++i) {
    if (arm.joints()[i].type != JointType::kFixed) return true;
  }
  return false;
}

class ParameterMaker {
 public:
  explicit ParameterMaker(ArmParameters& out) : out_(out) {}

  void row(std::size_t joint, ParameterKind kind, const std::string& symbol, double nominal) {
    const bool length = kind == ParameterKind::kD || kind == ParameterKind::kA;
    const std::string number = std::to_string(joint + 1);
    add({symbol + "_" + number, symbol + " of row " + number, length ? "m" : "rad", "row " + number,
         nominal, kScale},
        {kind, static_cast<int>(joint), 0});
  }

  /// Three shifts and, where wanted, three turns of the frame `name`.
  void frame(const std::string& name, int index, bool turns, ParameterKind shift,
             ParameterKind turn, const Vec3& nominal) {
    static constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
    const std::string number = index == 0 ? "" : std::to_string(index + 1);
    const std::string group = name + (index == 0 ? "" : " " + number);
    for (int axis = 0; axis < 3; ++axis) {
      add({name + number + "_" + kAxes[axis], std::string(kAxes[axis]) + " of the " + group, "m",
           group, nominal[axis], kScale},
          {shift, index, axis});
    }
    for (int axis = 0; turns && axis < 3; ++axis) {
      add({name + number + "_r" + kAxes[axis], "turn of the " + group + " about " + kAxes[axis],
           "rad", group, 0.0, kScale},
          {turn, index, axis});
    }
  }

  void plane(const std::string& name, int index, double offset) {
    const std::string group = "plane " + name;
    for (int axis = 0; axis < 2; ++axis) {
      add({"plane" + name + "_r" + std::to_string(axis + 1),
           "tilt " + std::to_string(axis + 1) + " of " + group, "rad", group, 0.0, kScale},
          {ParameterKind::kPlaneTurn, index, axis});
    }
    add({"plane" + name + "_offset", "offset of " + group, "m", group, offset, kScale},
        {ParameterKind::kPlaneShift, index, 0});
  }

 private:
  /// Typical errors of an arm are a millimetre or a milliradian.
  static constexpr double kScale = 1e-3;

  void add(Parameter parameter, ParameterSlot slot) {
    out_.parameters.push_back(std::move(parameter));
    out_.slots.push_back(slot);
  }

  ArmParameters& out_;
};

void add_rows(const Arm& arm, const ParameterChoice& choice, ParameterMaker& maker) {
  for (std::size_t k = 0; k < arm.joints().size(); ++k) {
    const Joint& joint = arm.joints()[k];
    if (joint.type == JointType::kFixed) continue;
    const Vec3 next = turn_to_next_axis(arm, k).col(2);
    const bool parallel = choice.parametrization == Parametrization::kHayati &&
                          has_next_axis(arm, k) &&
                          std::hypot(next.x(), next.y()) < choice.nearly_parallel;
    maker.row(k, ParameterKind::kTheta, "theta", joint.row.theta);
    if (!parallel) maker.row(k, ParameterKind::kD, "d", joint.row.d);
    maker.row(k, ParameterKind::kA, "a", joint.row.a);
    maker.row(k, ParameterKind::kAlpha, "alpha", joint.row.alpha);
    if (parallel) maker.row(k, ParameterKind::kBeta, "beta", joint.row.beta);
  }
}

Arm with_joints(const Arm& arm, std::vector<Joint> joints) {
  Arm changed(arm.name(), std::move(joints), arm.links(), arm.root(), arm.flange());
  changed.set_source(arm.source());
  return changed;
}

double& number_of(DhRow& row, ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kTheta:
      return row.theta;
    case ParameterKind::kD:
      return row.d;
    case ParameterKind::kA:
      return row.a;
    case ParameterKind::kAlpha:
      return row.alpha;
    default:
      return row.beta;
  }
}

}  // namespace

std::array<Vec3, 2> tilt_axes(const PlaneGuess& plane) {
  const Vec3 first = plane.normal.unitOrthogonal();
  return {first, plane.normal.cross(first)};
}

Eigen::VectorXd ArmParameters::nominal() const {
  Eigen::VectorXd x(static_cast<Index>(parameters.size()));
  for (Index i = 0; i < x.size(); ++i) x[i] = parameters[i].nominal;
  return x;
}

ArmParameters make_parameters(const Arm& arm, const Measurement& measurement,
                              std::vector<Pose> bases, std::vector<Pose> tools,
                              std::vector<PlaneGuess> planes, const ParameterChoice& choice) {
  ArmParameters out{arm, std::move(bases), std::move(tools), std::move(planes), {}, {}};
  out.arm.set_base(Pose::Identity());
  out.arm.set_tool(Pose::Identity());
  ParameterMaker maker(out);
  add_rows(arm, choice, maker);
  for (int i = 0; i < measurement.tools; ++i) {
    maker.frame("tool", i, measurement.has_rotation(), ParameterKind::kToolShift,
                ParameterKind::kToolTurn, out.tools[i].translation());
  }
  for (int i = choice.free_base ? 0 : 1; i < measurement.stations; ++i) {
    maker.frame("base", i, true, ParameterKind::kBaseShift, ParameterKind::kBaseTurn,
                out.bases[i].translation());
  }
  for (std::size_t i = 0; i < measurement.plane_names.size(); ++i) {
    maker.plane(measurement.plane_names[i], static_cast<int>(i), out.planes[i].offset);
  }
  return out;
}

ArmState state_at(const ArmParameters& parameters, const Eigen::VectorXd& x) {
  ArmState state{parameters.arm, parameters.bases, parameters.tools, parameters.planes};
  std::vector<Joint> joints = parameters.arm.joints();
  std::vector<Vec3> base_turn(parameters.bases.size(), Vec3::Zero());
  std::vector<Vec3> tool_turn(parameters.tools.size(), Vec3::Zero());
  std::vector<Vec3> plane_turn(parameters.planes.size(), Vec3::Zero());
  for (std::size_t i = 0; i < parameters.parameters.size(); ++i) {
    const auto [kind, index, axis] = parameters.slots[i];
    const double value = x[static_cast<Index>(i)];
    switch (kind) {
      case ParameterKind::kToolShift:
        state.tools[index].translation()[axis] = value;
        break;
      case ParameterKind::kToolTurn:
        tool_turn[index][axis] = value;
        break;
      case ParameterKind::kBaseShift:
        state.bases[index].translation()[axis] = value;
        break;
      case ParameterKind::kBaseTurn:
        base_turn[index][axis] = value;
        break;
      case ParameterKind::kPlaneTurn:
        plane_turn[index] += value * tilt_axes(parameters.planes[index])[axis];
        break;
      case ParameterKind::kPlaneShift:
        state.planes[index].offset = value;
        break;
      case ParameterKind::kEffect:
        break;
      default:
        number_of(joints[index].row, kind) = value;
    }
  }
  for (std::size_t i = 0; i < base_turn.size(); ++i) {
    state.bases[i].linear() = rotation_of(base_turn[i]) * state.bases[i].linear();
  }
  for (std::size_t i = 0; i < tool_turn.size(); ++i) {
    state.tools[i].linear() = state.tools[i].linear() * rotation_of(tool_turn[i]);
  }
  for (std::size_t i = 0; i < plane_turn.size(); ++i) {
    state.planes[i].normal = rotation_of(plane_turn[i]) * state.planes[i].normal;
  }
  state.arm = with_joints(parameters.arm, std::move(joints));
  return state;
}

}  // namespace bathyal
