// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/arm/tip_state.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bathyal/arm/internal/sincos.hpp"

namespace bathyal::arm {
namespace {

/// Two angles at a time, in the compiler's own notation.
struct Pair {
  using D = double __attribute__((vector_size(16)));
  using I = std::int64_t __attribute__((vector_size(16)));
  static constexpr int kLanes = 2;
};

void cross(const double* u, const double* v, double* w) {
  w[0] = u[1] * v[2] - u[2] * v[1];
  w[1] = u[2] * v[0] - u[0] * v[2];
  w[2] = u[0] * v[1] - u[1] * v[0];
}

double dot(const double* u, const double* v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

double norm(const double* u) { return std::sqrt(dot(u, u)); }

/// Rotation times vector, row by row.
void times(const double* rotation, const double* v, double* w) {
  for (int i = 0; i < 3; ++i) w[i] = dot(rotation + 3 * i, v);
}

void multiply(const double* a, const double* b, double* c) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
    }
  }
}

/// The rotation vector that turns `from` into `to`, along the world's axes. Half a turn has two;
/// either will do.
void rotation_between(const double* from, const double* to, double* vector) {
  double m[9];  // to * fromᵀ
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m[3 * i + j] = dot(to + 3 * i, from + 3 * j);
  }
  const double s[3] = {0.5 * (m[7] - m[5]), 0.5 * (m[2] - m[6]), 0.5 * (m[3] - m[1])};
  const double sine = norm(s), cosine = 0.5 * (m[0] + m[4] + m[8] - 1.0);
  const double angle = std::atan2(sine, cosine);
  if (cosine > -0.99) {
    const double factor = sine > 1e-9 ? angle / sine : 1.0;
    for (int i = 0; i < 3; ++i) vector[i] = factor * s[i];
    return;
  }
  // Near half a turn the sine is ill-conditioned: the axis is the longest column of m + mᵀ + (1 −
  // tr) I.
  int best = 0;
  for (int i = 1; i < 3; ++i) {
    if (m[4 * i] > m[4 * best]) best = i;
  }
  double axis[3];
  for (int i = 0; i < 3; ++i) {
    axis[i] = m[3 * i + best] + m[3 * best + i] + (i == best ? -2.0 * cosine : 0.0);
  }
  const double sign = dot(axis, s) < 0.0 ? -1.0 : 1.0;
  const double factor = sign * angle / norm(axis);
  for (int i = 0; i < 3; ++i) vector[i] = factor * axis[i];
}

/// The shortest rotation vector that turns the unit vector `from` into `to`.
void rotation_between_axes(const double* from, const double* to, double* vector) {
  cross(from, to, vector);
  const double sine = norm(vector);
  const double angle = std::atan2(sine, dot(from, to));
  if (sine > 1e-9) {
    for (int i = 0; i < 3; ++i) vector[i] *= angle / sine;
  } else if (angle > 1.0) {  // opposite: any perpendicular axis
    int least = 0;
    for (int i = 1; i < 3; ++i) {
      if (std::abs(from[i]) < std::abs(from[least])) least = i;
    }
    const double other[3] = {least == 0 ? 1.0 : 0.0, least == 1 ? 1.0 : 0.0,
                             least == 2 ? 1.0 : 0.0};
    cross(from, other, vector);
    const double length = norm(vector);
    for (int i = 0; i < 3; ++i) vector[i] *= angle / length;
  }
}

}  // namespace

TipState::TipState(const ForwardProgram& program, const TipTask& task)
    : program_(program),
      task_(task),
      sines_(program.step_count + 1),
      cosines_(program.step_count + 1),
      axes_(6 * program.step_count),
      jacobian_(6 * program.size) {}

void TipState::evaluate(const PlainPose& target, const double* q) {
  follow_chain(q);
  set_residual(target);
  set_jacobian();
}

void TipState::follow_chain(const double* q) {
  const std::size_t count = program_.step_count;
  for (std::size_t k = 0; k < count; k += 2) {
    Pair::D angles{};
    for (std::size_t lane = 0; lane < 2 && k + lane < count; ++lane) {
      const ForwardStep& step = program_.steps[k + lane];
      const bool turns = step.kind == StepKind::kRevolute;
      angles[lane] =
          (turns ? q[step.coordinate] * step.multiplier + step.offset : 0.0) + step.theta;
    }
    const SineCosine<Pair> turn = sincos<Pair>(angles);
    __builtin_memcpy(&sines_[k], &turn.sine, sizeof(double) * (k + 1 < count ? 2 : 1));
    __builtin_memcpy(&cosines_[k], &turn.cosine, sizeof(double) * (k + 1 < count ? 2 : 1));
  }

  const double* r = program_.world_from_first.rotation;
  double x[3] = {r[0], r[3], r[6]}, y[3] = {r[1], r[4], r[7]}, z[3] = {r[2], r[5], r[8]};
  double o[3] = {0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < count; ++k) {
    const ForwardStep& step = program_.steps[k];
    double* axis = &axes_[6 * k];
    const double s = sines_[k], c = cosines_[k];
    const double d = step.kind == StepKind::kPrismatic
                         ? step.d + (q[step.coordinate] * step.multiplier + step.offset)
                         : step.d;
    for (int i = 0; i < 3; ++i) {
      axis[i] = z[i];
      axis[3 + i] = o[i];
      const double turned_x = c * x[i] + s * y[i];
      const double turned_y = c * y[i] - s * x[i];
      o[i] += d * z[i] + step.a * turned_x;
      x[i] = turned_x;
      y[i] = step.cos_alpha * turned_y + step.sin_alpha * z[i];
      z[i] = step.cos_alpha * z[i] - step.sin_alpha * turned_y;
    }
    if (step.tilted) {
      for (int i = 0; i < 3; ++i) {
        const double turned_x = step.cos_beta * x[i] - step.sin_beta * z[i];
        z[i] = step.cos_beta * z[i] + step.sin_beta * x[i];
        x[i] = turned_x;
      }
    }
  }
  const double last[9] = {x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]};
  multiply(last, program_.last_from_tool.rotation, rotation_);
  times(last, program_.last_from_tool.translation, tip_);
  for (int i = 0; i < 3; ++i) tip_[i] += o[i];
}

void TipState::set_residual(const PlainPose& target) {
  for (int i = 0; i < 3; ++i) residual_[i] = target.translation[i] - tip_[i];
  double* turn = residual_ + 3;
  if (task_.kind == InverseTask::kPosition) {
    for (int i = 0; i < 3; ++i) turn[i] = 0.0;
  } else if (task_.kind == InverseTask::kPose) {
    rotation_between(rotation_, target.rotation, turn);
  } else {
    double now[3], wanted[3];
    times(rotation_, task_.axis, now);
    times(target.rotation, task_.axis, wanted);
    rotation_between_axes(now, wanted, turn);
  }
  position_error_ = norm(residual_);
  angle_error_ = norm(turn);
  for (int i = 0; i < 3; ++i) turn[i] *= task_.length;
}

void TipState::set_jacobian() {
  const std::size_t n = program_.size;
  const double length = task_.kind == InverseTask::kPosition ? 0.0 : task_.length;
  double free_axis[3] = {0.0, 0.0, 0.0};  // about which a turn does not count
  if (task_.kind == InverseTask::kPositionAxis) times(rotation_, task_.axis, free_axis);
  for (std::size_t k = 0; k < program_.step_count; ++k) {
    const ForwardStep& step = program_.steps[k];
    if (step.kind == StepKind::kFixed) continue;
    const double* z = &axes_[6 * k];
    double column[6] = {z[0], z[1], z[2], 0.0, 0.0, 0.0};
    if (step.kind == StepKind::kRevolute) {
      const double arm[3] = {tip_[0] - z[3], tip_[1] - z[4], tip_[2] - z[5]};
      cross(z, arm, column);
      const double along = dot(z, free_axis);
      for (int i = 0; i < 3; ++i) column[3 + i] = length * (z[i] - along * free_axis[i]);
    }
    for (std::size_t row = 0; row < 6; ++row) {
      double& entry = jacobian_[row * n + step.coordinate];
      const double value = step.multiplier * column[row];
      entry = step.leads ? value : entry + value;
    }
  }
  scale_ = 0.0;
  for (const double entry : jacobian_) scale_ += entry * entry;
}

}  // namespace bathyal::arm
