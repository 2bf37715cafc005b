// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "bathyal/diagnosis/arm_subject.hpp"
#include "bathyal/diagnosis/orthonormal.hpp"
#include "bathyal/identify/products.hpp"

// The sizes that values of one kind are held to, learned from the data.

namespace bathyal {
namespace {

constexpr std::size_t kRigid = 6;     ///< values of a rigid motion: more of a kind are learned
constexpr double kSizeSettled = 0.2;  ///< relative
constexpr int kSizeRounds = 40;
constexpr double kSizeFound = 0.02;   ///< relative, of sizes and noise where the model is linear
constexpr double kNoiseFound = 5e-3;  ///< relative
constexpr double kLeastSize = 1e-3;   ///< of what the effect's description calls plausible

}  // namespace

/// Standing ones whose sizes can be learned: the places of their values among the effects'.
std::map<ArmSubject::Family, std::vector<Index>> ArmSubject::large_families() const {
  std::map<Family, std::vector<Index>> out;
  Index count = 0;
  for (const int form : standing_) {
    for (std::size_t i = 0; i < sources_[form].variant.parameters.size(); ++i) {
      out[family_of(form)].push_back(count++);
    }
  }
  std::erase_if(out, [](const auto& family) { return family.second.size() <= kRigid; });
  return out;
}

/// Many values of one kind along one joint (a curve where it moves little, a dozen waves) have
/// directions that the data hardly tell. They are held to the size that the others show: the
/// evidence's own (MacKay 1992), Σ value² over the number of values that the data tell rather than
/// the prior. Sizes, noise and values are found together where the model is as at `x`, so that no
/// fit sets out with sizes at which weak directions run off to where it is another.
bool ArmSubject::learn_sizes(const Eigen::VectorXd& x) {
  const auto families = large_families();
  if (families.empty()) return false;
  const ArmSystem& system = *problem_.system;
  const Eigen::VectorXd y = system.scaled(x);
  const Eigen::MatrixXd to_free = moves();
  const Index wide = system.columns(), effects = wide - held_.rows(), last = held_.cols() + effects;
  Eigen::MatrixXd to_all = Eigen::MatrixXd::Zero(wide + 1, last + 1);
  to_all.topLeftCorner(wide, last) = to_free;
  to_all(wide, last) = 1.0;
  // By the data alone, about values of 0.
  Eigen::MatrixXd data = inner_products(to_all, product(system.square(y.data()), to_all, 1), 1);
  const Eigen::VectorXd values = y.tail(effects);
  Eigen::VectorXd held(effects);
  for (Index i = 0; i < effects; ++i) {
    const Column& column = problem_.columns.columns[geometry_ + static_cast<std::size_t>(i)];
    held[i] = column.prior_std / column.scale;
  }
  const auto own = Eigen::seqN(held_.cols(), effects);
  Eigen::VectorXd weight = held.cwiseAbs2().cwiseInverse();
  data.diagonal()(own) -= weight;
  data(own, last) -= weight.cwiseProduct(values);
  data(last, last) -= weight.dot(values.cwiseAbs2());
  data(last, last) += values.dot(data(own, own) * values) - 2.0 * values.dot(data(own, last));
  data.col(last).head(last) -= data(Eigen::seqN(0, last), own) * values;

  const double freedom = freedom_of_rows() - static_cast<double>(last);
  double noise = 1.0;
  std::map<Family, double> sizes;
  for (const auto& [family, places] : families) {
    sizes[family] = sizes_.try_emplace(family, 1.0).first->second;
  }
  for (int round = 0; round < kSizeRounds; ++round) {
    bool settled = true;
    const auto solve = [&] {
      Eigen::MatrixXd square = data.topLeftCorner(last, last) / (noise * noise);
      square.diagonal()(own) += weight;
      square.diagonal() *= 1.0 + kSwallowed * kSwallowed;
      return Eigen::LLT<Eigen::MatrixXd>(square);
    };
    const auto root = solve();
    const Eigen::VectorXd found = root.solve(-data.col(last).head(last) / (noise * noise));
    if (!problem_.options.noise && freedom > 0.5) {
      const double left = data(last, last) + 2.0 * found.dot(data.col(last).head(last)) +
                          found.dot(data.topLeftCorner(last, last) * found);
      const double next = std::sqrt(std::max(left, 0.0) / freedom);
      settled = std::abs(next / noise - 1.0) < kNoiseFound;
      const bool far = std::abs(next / noise - 1.0) > kSizeFound;
      noise = std::max(next, kLeastNoise);
      if (far) continue;  // with too much noise, all sizes look like none
    }
    const Eigen::VectorXd variance =
        solve().matrixL().solve(Eigen::MatrixXd::Identity(last, last)).colwise().squaredNorm();
    for (const auto& [family, places] : families) {
      double squares = 0.0, told = 0.0;
      for (const Index i : places) {
        squares += std::pow(found[held_.cols() + i], 2) * weight[i];
        told += 1.0 - variance[held_.cols() + i] * weight[i];
      }
      double& size = sizes[family];
      const double next =
          std::clamp(size * std::sqrt(squares / std::max(told, 1.0)), kLeastSize, 1.0);
      settled = settled && std::abs(next / size - 1.0) < kSizeFound;
      for (const Index i : places) weight[i] *= std::pow(size / next, 2);
      size = next;
    }
    if (settled) break;
  }
  bool learned = false;
  for (const auto& [family, places] : families) {
    double& size = sizes_[family];
    const double next = sizes[family];
    if (std::abs(next / size - 1.0) < kSizeSettled) continue;
    learned = true;
    for (const Index i : places) {
      problem_.columns.columns[geometry_ + static_cast<std::size_t>(i)].prior_std *= next / size;
    }
    size = next;
  }
  return learned;
}

}  // namespace bathyal
