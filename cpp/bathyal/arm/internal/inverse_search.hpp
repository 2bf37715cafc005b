// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "bathyal/arm/forward_kernel.hpp"
#include "bathyal/arm/inverse.hpp"

namespace bathyal::arm {

/// A way to solve targets begin … end − 1 into their rows of a result. `starts` is null or steps by
/// `start_step` numbers from target to target. May be called from several threads at once.
class InverseRows {
 public:
  virtual ~InverseRows() = default;
  virtual void solve(std::span<const PlainPose> targets, std::size_t begin, std::size_t end,
                     const double* starts, std::size_t start_step, InverseResult& result) const = 0;
};

/// Damped least squares from several starts. `arm` must outlive it.
std::unique_ptr<InverseRows> make_search(const Arm& arm, const InverseOptions& options);

}  // namespace bathyal::arm
