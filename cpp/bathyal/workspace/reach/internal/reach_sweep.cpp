// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/reach/internal/reach_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/base/parallel.hpp"

namespace bathyal::workspace {
namespace {

using Mat3 = Eigen::Matrix3d;
using Matrix = Eigen::MatrixXd;
using Rows6 = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t kBatch = 16384;   ///< postures between two scatters
constexpr int kSlabs = 32;              ///< of voxels, each written by one thread
constexpr float kShortStep = 0.3F;      ///< for which the first order is believed [rad], [m]
constexpr float kStepResidual = 0.02F;  ///< of a step, over the voxel's edge
constexpr double kSweepDamping = 1e-6;  ///< over the trace of J Jᵀ
constexpr float kNearest = 0.8F;        ///< cosine of what a step may turn the tool by

/// Coordinates along the first joint's axis, whose third it is: a sweep turns about it, or slides
/// along it.
struct AxisFrame {
  Mat3 vehicle_from_axis;
  Vec3 point;

  explicit AxisFrame(const ReachArm& arm) : point(arm.axis_point) {
    vehicle_from_axis.col(2) = arm.axis;
    vehicle_from_axis.col(0) = arm.axis.unitOrthogonal();
    vehicle_from_axis.col(1) = arm.axis.cross(Vec3(vehicle_from_axis.col(0)));
  }
};

/// One posture as the scatter needs it, in the frame of the axis; with the numbers of `Layout`.
struct Swept {
  float tip[3], z_axis[3];
  float side[2][3];                ///< unit vectors across z_axis
  float start = 0.0F, end = 0.0F;  ///< of the sweep, from the posture [rad], [m]
  float step = 0.0F;
  float low = 0.0F, high = 0.0F;  ///< of its voxels along the axis of the slabs
  float manipulability = 0.0F;
};

/// Where a posture's numbers lie in its row: q, J⁺ of five rows and I − J J⁺, the same of three.
struct Layout {
  explicit Layout(std::size_t n)
      : size(n), pinv5(n), left5(6 * n), pinv3(6 * n + 25), left3(9 * n + 25), total(9 * n + 34) {}
  std::size_t size, pinv5, left5, pinv3, left3, total;
};

struct Batch {
  JointMatrix q;
  std::vector<double> poses, jacobians;
  std::vector<Swept> swept;
  std::vector<float> numbers;
};

void compute(const ReachArm& arm, const PostureSequence& sequence, std::size_t first,
             std::size_t count, int num_threads, Batch& batch) {
  const auto rows = static_cast<Index>(count);
  const auto columns = static_cast<Index>(arm.size());
  batch.q.resize(rows, columns);
  for (std::size_t i = 0; i < count; ++i) {
    sequence.posture(first + i, batch.q.row(static_cast<Index>(i)).data());
  }
  batch.poses.resize(count * 16);
  batch.jacobians.resize(count * 6 * arm.size());
  compute_kinematics(arm.arm, view_of(batch.q),
                     {.poses = batch.poses, .jacobians = batch.jacobians}, num_threads);
}

void store_inverse(const Matrix& J, float* pinv, float* left) {
  const Index m = J.rows();
  Matrix normal = J * J.transpose();
  normal.diagonal().array() += kSweepDamping * normal.trace() + 1e-300;
  const Matrix inverse = J.transpose() * normal.llt().solve(Matrix::Identity(m, m));
  const Matrix rest = Matrix::Identity(m, m) - J * inverse;
  Eigen::Map<Eigen::Matrix<float, -1, -1, Eigen::RowMajor>>(pinv, J.cols(), m) =
      inverse.cast<float>();
  Eigen::Map<Eigen::Matrix<float, -1, -1, Eigen::RowMajor>>(left, m, m) = rest.cast<float>();
}

double yoshikawa(const Rows6& J) {
  const Matrix normal = J.cols() >= 6 ? Matrix(J * J.transpose()) : Matrix(J.transpose() * J);
  return normal.llt().matrixLLT().diagonal().cwiseMax(0.0).prod();
}

void set_range(const ReachArm& arm, const ReachGrid& grid, const AxisFrame& frame, int along,
               double q0, Swept& one) {
  if (arm.sweeps) {
    const double a = arm.rate * (arm.from[0] - q0);
    const double b = arm.rate * (arm.from[0] + arm.width[0] - q0);
    one.start = static_cast<float>(std::min(a, b));
    one.end = static_cast<float>(std::max(a, b));
  }
  const auto row = frame.vehicle_from_axis.row(along);
  const Vec3 tip(one.tip[0], one.tip[1], one.tip[2]);
  const double radius = std::hypot(tip.x(), tip.y());
  double low = row[2] * tip.z();
  double high = low;
  if (arm.turns) {
    const double swing = radius * std::hypot(row[0], row[1]);
    low -= swing;
    high += swing;
  } else {
    const double across = row[0] * tip.x() + row[1] * tip.y();
    low += across + row[2] * (row[2] > 0.0 ? one.start : one.end);
    high += across + row[2] * (row[2] > 0.0 ? one.end : one.start);
  }
  const double offset = frame.point[along] - grid.origin[along];
  one.low = static_cast<float>((low + offset) / grid.voxel - 1e-3);
  one.high = static_cast<float>((high + offset) / grid.voxel + 1e-3);
  const double step = arm.turns ? grid.voxel / std::max(radius, 0.2 * grid.voxel) : grid.voxel;
  one.step = static_cast<float>(step);
}

void prepare(const ReachArm& arm, const ReachGrid& grid, const AxisFrame& frame, int along,
             std::size_t i, Batch& batch) {
  const std::size_t n = arm.size();
  const Layout layout(n);
  const Mat3 axis_from_vehicle = frame.vehicle_from_axis.transpose();
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> pose(batch.poses.data() +
                                                                            16 * i);
  const Eigen::Map<const Rows6> jacobian(batch.jacobians.data() + 6 * n * i, 6,
                                         static_cast<Index>(n));
  const Vec3 tip = axis_from_vehicle * (pose.block<3, 1>(0, 3) - frame.point);
  const Vec3 z = axis_from_vehicle * pose.block<3, 1>(0, 2);
  const Vec3 side = z.unitOrthogonal();
  const Vec3 other = z.cross(side);
  Matrix J(5, static_cast<Index>(n));
  J.topRows(3) = axis_from_vehicle * jacobian.topRows(3);
  const Matrix turn = arm.length * axis_from_vehicle * jacobian.bottomRows(3);
  J.row(3) = side.transpose() * turn;
  J.row(4) = other.transpose() * turn;

  Swept& one = batch.swept[i];
  for (int k = 0; k < 3; ++k) {
    one.tip[k] = static_cast<float>(tip[k]);
    one.z_axis[k] = static_cast<float>(z[k]);
    one.side[0][k] = static_cast<float>(side[k]);
    one.side[1][k] = static_cast<float>(other[k]);
  }
  one.manipulability = static_cast<float>(yoshikawa(jacobian));
  set_range(arm, grid, frame, along, batch.q(static_cast<Index>(i), 0), one);
  float* numbers = batch.numbers.data() + i * layout.total;
  for (std::size_t j = 0; j < n; ++j) {
    numbers[j] = static_cast<float>(batch.q(static_cast<Index>(i), static_cast<Index>(j)));
  }
  if (arm.exact_directions) store_inverse(J, numbers + layout.pinv5, numbers + layout.left5);
  store_inverse(J.topRows(3), numbers + layout.pinv3, numbers + layout.left3);
}

/// Enters the voxels of one slab.
class Scatter {
 public:
  Scatter(const ReachArm& arm, const ReachGrid& grid, const AxisFrame& frame,
          const std::vector<Vec3>& approach, ReachState& state)
      : arm_(arm),
        grid_(grid),
        approach_(approach.size()),
        nearest_(approach),
        layout_(arm.size()),
        state_(state) {
    const double scale = 1.0 / grid.voxel;
    rotation_ = (scale * frame.vehicle_from_axis).cast<float>();
    turn_ = frame.vehicle_from_axis.cast<float>();
    offset_ = (scale * (frame.point - grid.origin)).cast<float>();
    back_ = (grid.voxel * frame.vehicle_from_axis.transpose()).cast<float>();
    for (std::size_t j = 0; j < arm.size(); ++j) {
      lower_.push_back(static_cast<float>(arm.lower[j]));
      upper_.push_back(static_cast<float>(arm.upper[j]));
    }
    for (const Vec3& d : approach) {
      along_.push_back((frame.vehicle_from_axis.transpose() * d).cast<float>());
    }
  }

  void enter(const Batch& batch, std::size_t i, std::size_t number, int along, int begin,
             int end) const {
    const Swept& one = batch.swept[i];
    const float* numbers = batch.numbers.data() + i * layout_.total;
    const float span = one.end - one.start;
    const int steps = std::max(1, static_cast<int>(std::ceil(span / one.step)));
    const float step = span / static_cast<float>(steps);
    // The first step lies elsewhere from posture to posture, else voxels would be left out.
    float t = one.start + step * shift(number);
    float c = std::cos(arm_.turns ? t : 0.0F);
    float s = std::sin(arm_.turns ? t : 0.0F);
    const float dc = std::cos(arm_.turns ? step : 0.0F);
    const float ds = std::sin(arm_.turns ? step : 0.0F);
    for (int k = 0; k < steps; ++k) {
      const float tip[3] = {one.tip[0] * c - one.tip[1] * s, one.tip[0] * s + one.tip[1] * c,
                            arm_.turns ? one.tip[2] : one.tip[2] + t};
      int at[3];
      bool inside = true;
      for (int r = 0; r < 3; ++r) {
        const float x = rotation_(r, 0) * tip[0] + rotation_(r, 1) * tip[1] +
                        rotation_(r, 2) * tip[2] + offset_[r];
        at[r] = static_cast<int>(x);
        inside = inside && x >= 0.0F && at[r] < grid_.count[r];
      }
      if (inside && at[along] >= begin && at[along] < end) {
        visit(one, numbers, number, {at[0], at[1], at[2]}, t, c, s);
      }
      t += step;
      const float next = c * dc - s * ds;
      s = s * dc + c * ds;
      c = next;
    }
  }

 private:
  static float shift(std::size_t number) {
    const double at = 0.5 + 0.6180339887498949 * static_cast<double>(number);
    return static_cast<float>(at - std::floor(at));
  }

  std::uint32_t code(const Swept& one, std::size_t number, float t) const {
    if (!arm_.sweeps) return ReachPostures::drawn(number, 0);
    const float share = (t - one.start) / (one.end - one.start);
    const float part = (arm_.rate > 0.0 ? share : 1.0F - share) * ReachPostures::kParts;
    return ReachPostures::drawn(
        number, static_cast<std::uint32_t>(std::clamp(part, 0.0F, ReachPostures::kParts - 1.0F)));
  }

  void visit(const Swept& one, const float* numbers, std::size_t number, const Eigen::Array3i& at,
             float t, float c, float s) const {
    const std::size_t voxel = grid_.index(at);
    if (one.manipulability > state_.manipulability[voxel]) {
      state_.manipulability[voxel] = one.manipulability;
      state_.best[voxel] = code(one, number, t);
    }
    const float zx = one.z_axis[0] * c - one.z_axis[1] * s;
    const float zy = one.z_axis[0] * s + one.z_axis[1] * c;
    const float zz = one.z_axis[2];
    const std::size_t i = nearest_(turn_(0, 0) * zx + turn_(0, 1) * zy + turn_(0, 2) * zz,
                                   turn_(1, 0) * zx + turn_(1, 1) * zy + turn_(1, 2) * zz,
                                   turn_(2, 0) * zx + turn_(2, 1) * zy + turn_(2, 2) * zz);
    const bool along = has(state_.set[voxel], i);
    if (along && has(state_.set[voxel], approach_)) return;

    // From the posture as drawn, the voxel's middle turned back.
    const Eigen::Vector3f middle =
        back_ * (at.cast<float>().matrix() + Eigen::Vector3f::Constant(0.5F) - offset_);
    float error[5] = {middle[0] * c + middle[1] * s - one.tip[0],
                      middle[1] * c - middle[0] * s - one.tip[1],
                      middle[2] - (arm_.turns ? 0.0F : t) - one.tip[2], 0.0F, 0.0F};
    const float* q = numbers;
    if (step_is_good<3>(q, numbers + layout_.pinv3, numbers + layout_.left3, error, t)) {
      enter_set(voxel, approach_, one, number, t);
      if (!arm_.exact_directions) enter_set(voxel, i, one, number, t);
    }
    if (along || !arm_.exact_directions) return;
    const Eigen::Vector3f& want = along_[i];
    const float w[3] = {want[0] * c + want[1] * s, want[1] * c - want[0] * s, want[2]};
    const float* z = one.z_axis;
    const float cosine = z[0] * w[0] + z[1] * w[1] + z[2] * w[2];
    if (cosine < kNearest) return;
    const float scale = static_cast<float>(arm_.length) * (1.0F + (1.0F - cosine) / 3.0F);
    const float cross[3] = {z[1] * w[2] - z[2] * w[1], z[2] * w[0] - z[0] * w[2],
                            z[0] * w[1] - z[1] * w[0]};
    for (int r = 0; r < 2; ++r) {
      const float* side = one.side[r];
      error[3 + r] = scale * (side[0] * cross[0] + side[1] * cross[1] + side[2] * cross[2]);
    }
    if (step_is_good<5>(q, numbers + layout_.pinv5, numbers + layout_.left5, error, t)) {
      enter_set(voxel, i, one, number, t);
    }
  }

  void enter_set(std::size_t voxel, std::size_t i, const Swept& one, std::size_t number,
                 float t) const {
    if (has(state_.set[voxel], i)) return;
    insert(state_.set[voxel], i);
    state_.posture[voxel * (approach_ + 1) + i] = code(one, number, t);
  }

  template <int M>
  bool step_is_good(const float* q, const float* pinv, const float* left, const float* error,
                    float t) const {
    for (std::size_t j = 0; j < layout_.size; ++j) {
      float step = 0.0F;
      for (int k = 0; k < M; ++k) step += pinv[j * M + static_cast<std::size_t>(k)] * error[k];
      if (!(std::abs(step) <= kShortStep)) return false;
      float value = q[j] + step;
      if (j == 0 && arm_.sweeps) value += t / static_cast<float>(arm_.rate);
      if (value < lower_[j] || value > upper_[j]) return false;
    }
    float rest = 0.0F;
    for (int r = 0; r < M; ++r) {
      float sum = 0.0F;
      for (int k = 0; k < M; ++k) sum += left[r * M + k] * error[k];
      rest += sum * sum;
    }
    const float most = kStepResidual * static_cast<float>(grid_.voxel);
    return rest <= most * most;
  }

  const ReachArm& arm_;
  const ReachGrid& grid_;
  std::size_t approach_;
  NearestDirection nearest_;
  Layout layout_;
  ReachState& state_;
  Eigen::Matrix3f rotation_, turn_, back_;
  Eigen::Vector3f offset_;
  std::vector<float> lower_, upper_;
  std::vector<Eigen::Vector3f> along_;
};

}  // namespace

void sweep_postures(const ReachArm& arm, const ReachGrid& grid, const std::vector<Vec3>& approach,
                    const PostureSequence& sequence, std::size_t samples, int num_threads,
                    ReachState& state) {
  const AxisFrame frame(arm);
  // Circles lie within one slab, or few.
  Index along_index = 0;
  arm.axis.cwiseAbs().maxCoeff(&along_index);
  const int along = static_cast<int>(along_index);
  const int thickness = std::max(1, grid.count[along] / kSlabs);
  const int slabs = (grid.count[along] + thickness - 1) / thickness;
  const Scatter scatter(arm, grid, frame, approach, state);
  Batch batch;
  for (std::size_t first = 0; first < samples; first += kBatch) {
    const std::size_t count = std::min(kBatch, samples - first);
    compute(arm, sequence, first, count, num_threads, batch);
    batch.swept.resize(count);
    batch.numbers.resize(count * Layout(arm.size()).total);
    parallel_for(count, 512, num_threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) prepare(arm, grid, frame, along, i, batch);
    });
    parallel_for(
        static_cast<std::size_t>(slabs), 1, num_threads,
        [&](std::size_t slab, std::size_t /*end*/) {
          const int begin = static_cast<int>(slab) * thickness;
          const int end = std::min(begin + thickness, grid.count[along]);
          for (std::size_t i = 0; i < count; ++i) {
            const Swept& one = batch.swept[i];
            if (one.high < static_cast<float>(begin) || one.low >= static_cast<float>(end)) {
              continue;
            }
            scatter.enter(batch, i, first + i, along, begin, end);
          }
        });
  }
}

Eigen::AlignedBox3d box_of_tips(const ReachArm& arm, const PostureSequence& sequence,
                                std::size_t samples, int num_threads) {
  constexpr int kPlaces = 24;  ///< of the first joint
  Batch batch;
  compute(arm, sequence, 0, samples, num_threads, batch);
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < samples; ++i) {
    const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> pose(batch.poses.data() +
                                                                              16 * i);
    const Vec3 tip = pose.block<3, 1>(0, 3);
    box.extend(tip);
    for (int k = 0; arm.sweeps && k <= kPlaces; ++k) {
      const double q0 = arm.from[0] + arm.width[0] * k / kPlaces;
      const double by = arm.rate * (q0 - batch.q(static_cast<Index>(i), 0));
      const Vec3 from_axis = tip - arm.axis_point;
      box.extend(arm.turns ? Vec3(arm.axis_point + Eigen::AngleAxisd(by, arm.axis) * from_axis)
                           : Vec3(tip + by * arm.axis));
    }
  }
  return box;
}

}  // namespace bathyal::workspace
