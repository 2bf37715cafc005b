// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/arm/forward_kernel.hpp"
#include "bathyal/arm/internal/sincos.hpp"
#include "bathyal/base/lanes.hpp"

// Forward kinematics of several poses side by side, one a lane: written once, compiled for each
// instruction set. Every lane goes through the same operations whatever the width, and nothing is
// contracted, so that all sets give the same bytes.

namespace bathyal::arm {

template <class V>
struct LaneVector {
  typename V::D x, y, z;
};

/// Columns of the rotation and the origin.
template <class V>
struct LaneFrame {
  LaneVector<V> x, y, z, origin;
};

/// a u + b v
template <class V, class A, class B>
inline LaneVector<V> combine(A a, const LaneVector<V>& u, B b, const LaneVector<V>& v) {
  return {a * u.x + b * v.x, a * u.y + b * v.y, a * u.z + b * v.z};
}

template <class V>
inline typename V::D dot(const LaneVector<V>& u, const LaneVector<V>& v) {
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

template <class V>
inline LaneVector<V> cross(const LaneVector<V>& u, const LaneVector<V>& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

/// Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta), a column at a time.
template <class V>
inline void advance(const ForwardStep& step, const double* q, LaneFrame<V>& frame) {
  using D = typename V::D;
  D sine = D{} + step.sin_theta, cosine = D{} + step.cos_theta, d = D{} + step.d;
  if (step.kind != StepKind::kFixed) {
    const D value = load<V>(q + step.coordinate * V::kLanes) * step.multiplier + step.offset;
    if (step.kind == StepKind::kRevolute) {
      const SineCosine<V> turn = sincos<V>(value + step.theta);
      sine = turn.sine;
      cosine = turn.cosine;
    } else {
      d = d + value;
    }
  }
  const LaneVector<V> x = combine<V>(cosine, frame.x, sine, frame.y);
  const LaneVector<V> y = combine<V>(cosine, frame.y, -sine, frame.x);
  const LaneVector<V> moved = combine<V>(d, frame.z, step.a, x);
  frame.origin = combine<V>(1.0, frame.origin, 1.0, moved);
  frame.x = x;
  frame.y = y;
  if (step.turned) {
    const LaneVector<V> z = frame.z;
    frame.y = combine<V>(step.cos_alpha, y, step.sin_alpha, z);
    frame.z = combine<V>(step.cos_alpha, z, -step.sin_alpha, y);
  }
  if (step.tilted) {
    const LaneVector<V> z = frame.z;
    frame.x = combine<V>(step.cos_beta, x, -step.sin_beta, z);
    frame.z = combine<V>(step.cos_beta, z, step.sin_beta, x);
  }
}

template <class V>
inline LaneFrame<V> times(const LaneFrame<V>& frame, const PlainPose& pose) {
  const double* r = pose.rotation;
  const double* t = pose.translation;
  const auto along = [&](double a, double b, double c) {
    return combine<V>(1.0, combine<V>(a, frame.x, b, frame.y), c, frame.z);
  };
  return {along(r[0], r[3], r[6]), along(r[1], r[4], r[7]), along(r[2], r[5], r[8]),
          combine<V>(1.0, frame.origin, 1.0, along(t[0], t[1], t[2]))};
}

/// The first frame, its origin left at zero: the world's offset is added when a pose is stored, so
/// that an arm in survey coordinates keeps its Jacobian's digits.
template <class V>
inline LaneFrame<V> first_frame(const ForwardProgram& program) {
  using D = typename V::D;
  const double* r = program.world_from_first.rotation;
  return {{D{} + r[0], D{} + r[3], D{} + r[6]},
          {D{} + r[1], D{} + r[4], D{} + r[7]},
          {D{} + r[2], D{} + r[5], D{} + r[8]},
          {D{}, D{}, D{}}};
}

/// `rows` numbers of each lane, from rows of lanes to one run a pose, `stride` apart.
template <class V>
inline void spread(const double* lanes, std::size_t rows, double* out, std::size_t stride,
                   std::size_t count) {
  for (std::size_t lane = 0; lane < count; ++lane) {
    for (std::size_t i = 0; i < rows; ++i) out[lane * stride + i] = lanes[i * V::kLanes + lane];
  }
}

template <class V>
inline void store_pose(const LaneFrame<V>& frame, const ForwardProgram& program, double* lanes,
                       double* out, std::size_t stride, std::size_t count) {
  const double* t = program.world_from_first.translation;
  const LaneVector<V>* columns[3] = {&frame.x, &frame.y, &frame.z};
  for (std::size_t c = 0; c < 3; ++c) {
    store<V>(lanes + c * V::kLanes, columns[c]->x);
    store<V>(lanes + (4 + c) * V::kLanes, columns[c]->y);
    store<V>(lanes + (8 + c) * V::kLanes, columns[c]->z);
    store<V>(lanes + (12 + c) * V::kLanes, typename V::D{});
  }
  store<V>(lanes + 3 * V::kLanes, frame.origin.x + t[0]);
  store<V>(lanes + 7 * V::kLanes, frame.origin.y + t[1]);
  store<V>(lanes + 11 * V::kLanes, frame.origin.z + t[2]);
  store<V>(lanes + 15 * V::kLanes, typename V::D{} + 1.0);
  spread<V>(lanes, 16, out, stride, count);
}

/// One joint's column: [z × (tip − o); z] turning, [z; 0] sliding.
template <class V>
inline void add_column(const ForwardStep& step, const double* axis, const LaneFrame<V>& tip,
                       bool tool_frame, std::size_t size, double* columns) {
  using D = typename V::D;
  const std::size_t lanes = V::kLanes;
  const LaneVector<V> z{load<V>(axis), load<V>(axis + lanes), load<V>(axis + 2 * lanes)};
  LaneVector<V> linear = z, angular{D{}, D{}, D{}};
  if (step.kind == StepKind::kRevolute) {
    const LaneVector<V> o{load<V>(axis + 3 * lanes), load<V>(axis + 4 * lanes),
                          load<V>(axis + 5 * lanes)};
    linear = cross<V>(z, combine<V>(1.0, tip.origin, -1.0, o));
    angular = z;
  }
  if (tool_frame) {
    linear = {dot<V>(tip.x, linear), dot<V>(tip.y, linear), dot<V>(tip.z, linear)};
    angular = {dot<V>(tip.x, angular), dot<V>(tip.y, angular), dot<V>(tip.z, angular)};
  }
  const D entries[6] = {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z};
  for (std::size_t row = 0; row < 6; ++row) {
    double* entry = columns + (row * size + step.coordinate) * lanes;
    const D value = entries[row] * step.multiplier;
    store<V>(entry, step.leads ? value : load<V>(entry) + value);
  }
}

/// `count` poses from `row` on, at most one a lane; idle lanes repeat the last.
template <class V>
inline void forward_group(const ForwardProgram& program, const ForwardBatch& batch, std::size_t row,
                          std::size_t count) {
  const std::size_t lanes = V::kLanes, size = program.size;
  double* q = batch.scratch;
  double* axes = q + size * lanes;  // z and origin of every step, as it finds them
  double* columns = axes + 6 * program.step_count * lanes;
  double* pose = columns + 6 * size * lanes;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const double* from = batch.q + (row + (lane < count ? lane : count - 1)) * size;
    for (std::size_t i = 0; i < size; ++i) q[i * lanes + lane] = from[i];
  }

  const std::size_t link_stride = 16 * (program.step_count + 1);
  const auto store_link = [&](std::size_t link, const LaneFrame<V>& frame) {
    store_pose<V>(times<V>(frame, program.row_from_link[link]), program, pose,
                  batch.links + row * link_stride + 16 * link, link_stride, count);
  };
  LaneFrame<V> frame = first_frame<V>(program);
  if (batch.links != nullptr) store_link(0, frame);
  for (std::size_t k = 0; k < program.step_count; ++k) {
    double* axis = axes + 6 * k * lanes;
    store<V>(axis, frame.z.x);
    store<V>(axis + lanes, frame.z.y);
    store<V>(axis + 2 * lanes, frame.z.z);
    store<V>(axis + 3 * lanes, frame.origin.x);
    store<V>(axis + 4 * lanes, frame.origin.y);
    store<V>(axis + 5 * lanes, frame.origin.z);
    advance<V>(program.steps[k], q, frame);
    if (batch.links != nullptr) store_link(k + 1, frame);
  }
  const LaneFrame<V> tip = times<V>(frame, program.last_from_tool);
  if (batch.poses != nullptr) {
    store_pose<V>(tip, program, pose, batch.poses + 16 * row, 16, count);
  }
  if (batch.jacobians == nullptr) return;
  for (std::size_t k = 0; k < program.step_count; ++k) {
    const ForwardStep& step = program.steps[k];
    if (step.kind == StepKind::kFixed) continue;
    add_column<V>(step, axes + 6 * k * lanes, tip, batch.tool_frame, size, columns);
  }
  spread<V>(columns, 6 * size, batch.jacobians + 6 * size * row, 6 * size, count);
}

template <class V>
void forward(const ForwardProgram& program, const ForwardBatch& batch) {
  for (std::size_t row = batch.begin; row < batch.end; row += V::kLanes) {
    const std::size_t left = batch.end - row;
    forward_group<V>(program, batch, row, left < V::kLanes ? left : V::kLanes);
  }
}

}  // namespace bathyal::arm
