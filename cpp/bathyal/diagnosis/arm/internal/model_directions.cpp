// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>

#include "bathyal/diagnosis/arm/internal/model.hpp"
#include "bathyal/identify/model/chain_derivatives.hpp"

// Where the tips are, and along which directions their residuals are resolved.

namespace bathyal::diagnosis {

std::vector<Vec3> ArmModel::tips() const {
  std::vector<Vec3> tips;
  const ChainDerivatives walk(problem_.parameters, x_, {});
  ChainFrames frames;
  for (Index i = 0; i < m_.rows(); ++i) {
    tips.push_back(
        walk.tip(m_.q.row(i).data(), i, m_.tool[i], m_.station[i], frames, nullptr, nullptr, 0)
            .translation());
  }
  return tips;
}

Eigen::VectorXd ArmModel::ranges() const {
  const std::vector<Vec3> world = tips();
  Eigen::VectorXd out(m_.rows());
  for (Index i = 0; i < m_.rows(); ++i) out[i] = world[static_cast<std::size_t>(i)].norm();
  return out;
}

Eigen::Matrix3Xd ArmModel::tips_from_base() const {
  const std::vector<Vec3> world = tips();
  Eigen::Matrix3Xd out(3, m_.rows());
  for (Index i = 0; i < m_.rows(); ++i) {
    out.col(i) = fit_.bases[m_.station[i]].inverse() * world[static_cast<std::size_t>(i)];
  }
  return out;
}

std::vector<Eigen::MatrixXd> ArmModel::directions() const {
  const auto rows = static_cast<Index>(m_.rows());
  const auto acting_on = [](std::vector<Perturbation> perturbations) {
    ActingVariant out;
    out.variant.effect = "direction";
    for (Perturbation& perturbation : perturbations) {
      out.variant.parameters.push_back({std::to_string(out.perturbations.size()), "", 1.0});
      out.perturbations.push_back({std::move(perturbation)});
    }
    return out;
  };
  std::vector<ActingVariant> acting;
  for (const int frame : {0, static_cast<int>(nominal_.joints().size()) + 1}) {
    std::vector<Perturbation> shifts;
    for (int axis = 0; axis < 3; ++axis) {
      shifts.push_back({PerturbationSite::kFrame, frame, RowMatrix::Zero(rows, 6)});
      shifts.back().values.col(axis).setOnes();
    }
    acting.push_back(acting_on(std::move(shifts)));
  }
  const std::vector<Vec3> world = tips();
  Perturbation sight{PerturbationSite::kFrame, 0, RowMatrix::Zero(rows, 6)};
  // Of touches no instrument measures a distance; tips less their point's mean would be residuals.
  for (Index i = 0; m_.tracked && i < rows; ++i) {
    const Vec3& tip = world[static_cast<std::size_t>(i)];
    sight.values.row(i).head<3>() =
        (fit_.bases[m_.station[i]].linear().transpose() * tip.normalized()).transpose();
  }
  acting.push_back(acting_on({std::move(sight)}));
  for (int j = 0; j < static_cast<int>(data_.q.cols()); ++j)
    acting.push_back(acting_on({{PerturbationSite::kJoint, j, RowMatrix::Ones(rows, 1)}}));
  std::vector<Eigen::MatrixXd> out;
  for (ParameterColumns& one : columns_of(std::move(acting))) out.push_back(std::move(one.columns));
  return out;
}

}  // namespace bathyal::diagnosis
