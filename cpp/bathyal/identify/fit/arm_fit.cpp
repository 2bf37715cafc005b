// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/identify/fit/arm_fit.hpp"

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"

namespace bathyal {

std::string_view to_text(Status status) {
  switch (status) {
    case Status::kIdentified:
      return "identified";
    case Status::kGauge:
      return "gauge";
    case Status::kPrior:
      return "prior";
    case Status::kNotIdentifiable:
      return "not_identifiable";
    case Status::kFixed:
      return "fixed";
    case Status::kPruned:
      return "pruned";
  }
  return "";
}

std::vector<Eigen::Matrix3d> tip_covariance(const ArmFit& fit, const RowMatrix& q,
                                            int num_threads) {
  if (q.cols() != fit.arm.size()) {
    throw_argument("q", std::to_string(fit.arm.size()) + " columns", std::to_string(q.cols()));
  }
  if (!q.allFinite()) throw_argument("q", "finite numbers", "nan or inf");
  constexpr std::size_t kPosesPerChunk = 256;
  constexpr double kVisible = 1e-5;  // [m] per mm or mrad of an undetermined direction

  // The base of the first station is the reference frame of the tips: it adds nothing.
  std::vector<int> wanted;
  for (int i = 0; i < static_cast<int>(fit.arm_parameters.slots.size()); ++i) {
    const ParameterSlot& place = fit.arm_parameters.slots[i];
    if (is_row(place) || place.kind == ParameterKind::kToolShift) wanted.push_back(i);
  }
  const auto columns = static_cast<Index>(wanted.size());
  const Eigen::MatrixXd covariance = fit.covariance(wanted, wanted);
  const Eigen::MatrixXd undetermined = fit.undetermined(wanted, Eigen::all);
  const ChainDerivatives chain(fit.arm_parameters, fit.values, wanted);
  const Eigen::Matrix3d base_from_world = chain.state().bases[0].linear().transpose();
  std::vector<Eigen::Matrix3d> out(static_cast<std::size_t>(q.rows()));
  parallel_for(out.size(), kPosesPerChunk, num_threads, [&](std::size_t begin, std::size_t end) {
    ChainFrames frames;
    Eigen::Matrix3Xd jacobian(3, columns);
    for (std::size_t i = begin; i < end; ++i) {
      chain.tip(q.row(static_cast<Index>(i)).data(), kNoRow, 0, 0, frames, jacobian.data(), nullptr,
                3);
      jacobian = base_from_world * jacobian;
      out[i] = jacobian * covariance * jacobian.transpose();
      if (undetermined.cols() == 0) continue;
      const Eigen::Vector3d moved = (jacobian * undetermined).rowwise().norm();
      for (int axis = 0; axis < 3; ++axis) {
        if (moved[axis] > kVisible) out[i](axis, axis) = std::numeric_limits<double>::infinity();
      }
    }
  });
  return out;
}

}  // namespace bathyal
