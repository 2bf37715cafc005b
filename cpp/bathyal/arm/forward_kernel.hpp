// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

// The border between the arm and the kernels that are compiled once for each instruction set:
// plain numbers and pointers only.

namespace bathyal::arm {

/// A rigid motion: the rotation row by row, then the translation.
struct PlainPose {
  double rotation[9];
  double translation[3];
};

enum class StepKind { kRevolute, kPrismatic, kFixed };

/// A row of the arm with what need not be computed for each pose.
struct ForwardStep {
  StepKind kind;
  bool leads;   ///< the first joint of its coordinate: its Jacobian column is set, not added to
  bool turned;  ///< alpha is not 0
  bool tilted;  ///< beta is not 0
  std::size_t coordinate;
  double multiplier, offset;
  double theta, cos_theta, sin_theta;
  double d, a;
  double cos_alpha, sin_alpha;
  double cos_beta, sin_beta;
};

struct ForwardProgram {
  const ForwardStep* steps;
  std::size_t step_count;
  std::size_t size;                ///< coordinates
  PlainPose world_from_first;      ///< base * root
  PlainPose last_from_tool;        ///< flange * tool
  const PlainPose* row_from_link;  ///< step_count + 1 of them
};

/// Poses begin … end − 1. What is null is not computed.
struct ForwardBatch {
  const double* q;  ///< (N, size), finite
  std::size_t begin;
  std::size_t end;
  double* poses;      ///< (N, 4, 4) world_from_tool
  double* links;      ///< (N, step_count + 1, 4, 4) world_from_link
  double* jacobians;  ///< (N, 6, size)
  bool tool_frame;    ///< of the Jacobian: along the tool's axes, not the world's
  double* scratch;    ///< scratch_size(program) numbers
};

inline constexpr std::size_t kMostLanes = 8;

inline std::size_t scratch_size(const ForwardProgram& program) {
  return kMostLanes * (7 * program.size + 6 * program.step_count + 16);
}

using ForwardKernel = void (*)(const ForwardProgram&, const ForwardBatch&);

void baseline_forward(const ForwardProgram& program, const ForwardBatch& batch);
#if defined(BATHYAL_X86_KERNELS)
void avx2_forward(const ForwardProgram& program, const ForwardBatch& batch);
void avx512_forward(const ForwardProgram& program, const ForwardBatch& batch);
#endif

}  // namespace bathyal::arm
