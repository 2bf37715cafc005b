// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/selection/autocorrelation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "bathyal/base/parallel.hpp"

namespace bathyal::selection {
namespace {

constexpr Index kMaxObservations = 1000;
constexpr Index kMinObservations = 30;
constexpr double kDoubtful = 0.01, kBeyondDoubt = 1e-12;  ///< p-values between are computed exactly
constexpr int kMaxExact = 12;                             ///< so many of them
constexpr Index kMaxExactSize = 900;                      ///< of the matrix

/// Neighbours of an observation: in few dimensions many are near.
Index neighbours(Index observations, Index dimensions) {
  if (dimensions == 1) return std::clamp<Index>(observations / 12, 4, 24);
  if (dimensions == 2) return std::clamp<Index>(observations / 25, 4, 12);
  return 6;
}

/// A symmetric graph: of each observation its neighbours and their weights, without itself.
using Graph = std::vector<std::vector<std::pair<int, double>>>;

Graph symmetric(const std::vector<std::vector<int>>& nearest) {
  Graph out(nearest.size());
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    for (const int k : nearest[i]) {
      out[i].emplace_back(k, 0.5);
      out[static_cast<std::size_t>(k)].emplace_back(static_cast<int>(i), 0.5);
    }
  }
  for (auto& edges : out) {
    std::sort(edges.begin(), edges.end());
    std::vector<std::pair<int, double>> merged;
    for (const auto& [k, weight] : edges) {
      if (!merged.empty() && merged.back().first == k) {
        merged.back().second += weight;
      } else {
        merged.emplace_back(k, weight);
      }
    }
    edges = std::move(merged);
  }
  return out;
}

Graph neighbourhood(const Eigen::MatrixXd& coordinates) {
  const Index n = coordinates.rows(), dimensions = coordinates.cols();
  const Index k = neighbours(n, dimensions);
  std::vector<std::vector<int>> nearest(static_cast<std::size_t>(n));
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  if (dimensions == 1) {
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return coordinates(a, 0) < coordinates(b, 0); });
    for (Index i = 0; i < n; ++i) {
      for (Index step = 1; step <= k / 2 && i + step < n; ++step)
        nearest[static_cast<std::size_t>(order[i])].push_back(order[i + step]);
    }
    return symmetric(nearest);
  }
  const Eigen::MatrixXd points = coordinates.transpose();
  for (Index i = 0; i < n; ++i) {
    const Eigen::VectorXd distance = (points.colwise() - points.col(i)).colwise().squaredNorm();
    std::vector<int> others = order;
    others.erase(others.begin() + i);
    const auto end = others.begin() + std::min<Index>(k, n - 1);
    std::partial_sort(others.begin(), end, others.end(), [&](int a, int b) {
      return std::pair(distance[a], a) < std::pair(distance[b], b);
    });
    nearest[static_cast<std::size_t>(i)].assign(others.begin(), end);
  }
  return symmetric(nearest);
}

/// S times columns.
Eigen::MatrixXd smoothed(const Graph& graph, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(columns.rows(), columns.cols());
  for (std::size_t i = 0; i < graph.size(); ++i) {
    for (const auto& [k, weight] : graph[i])
      out.row(static_cast<Index>(i)) += weight * columns.row(k);
  }
  return out;
}

/// Sums over the edges and over the triangles of a graph: traces of S² and S³.
struct GraphSums {
  double weights = 0.0, squares = 0.0, cubes = 0.0;
};

GraphSums sums_of(const Graph& graph) {
  GraphSums out;
  std::vector<double> row(graph.size(), 0.0);
  for (const auto& edges : graph) {
    for (const auto& [k, weight] : edges) row[static_cast<std::size_t>(k)] = weight;
    for (const auto& [k, weight] : edges) {
      out.weights += weight;
      out.squares += weight * weight;
      for (const auto& [l, other] : graph[static_cast<std::size_t>(k)])
        out.cubes += weight * other * row[static_cast<std::size_t>(l)];
    }
    for (const auto& [k, weight] : edges) row[static_cast<std::size_t>(k)] = 0.0;
  }
  return out;
}

/// Rows resolved along a direction whose components are orthonormal in each observation.
struct Resolved {
  std::vector<Eigen::MatrixXd> basis;     ///< of each component, (n, b)
  std::vector<Eigen::VectorXd> residual;  ///< of each component, (n,)
};

Resolved resolve(const Eigen::MatrixXd& direction, const std::vector<std::vector<Index>>& rows,
                 const Eigen::MatrixXd& basis, const Eigen::VectorXd& residual) {
  const auto n = static_cast<Index>(rows.size());
  const Index components = direction.cols();
  Resolved out;
  out.basis.assign(static_cast<std::size_t>(components), Eigen::MatrixXd::Zero(n, basis.cols()));
  out.residual.assign(static_cast<std::size_t>(components), Eigen::VectorXd::Zero(n));
  for (Index i = 0; i < n; ++i) {
    const std::vector<Index>& own = rows[static_cast<std::size_t>(i)];
    const Eigen::MatrixXd loads = direction(own, Eigen::all);
    // The symmetric inverse root keeps the components along the direction's own axes.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(loads.transpose() * loads);
    const double largest = eigen.eigenvalues().maxCoeff();
    if (!(largest > 0.0)) continue;
    const Eigen::VectorXd inverse_root = eigen.eigenvalues().unaryExpr(
        [&](double value) { return value > 1e-9 * largest ? 1.0 / std::sqrt(value) : 0.0; });
    const Eigen::MatrixXd unit =
        loads * eigen.eigenvectors() * inverse_root.asDiagonal() * eigen.eigenvectors().transpose();
    const Eigen::MatrixXd along = unit.transpose() * basis(own, Eigen::all);
    const Eigen::VectorXd value = unit.transpose() * residual(own);
    for (Index c = 0; c < components; ++c) {
      out.basis[static_cast<std::size_t>(c)].row(i) = along.row(c);
      out.residual[static_cast<std::size_t>(c)][i] = value[c];
    }
  }
  return out;
}

/// Probability that a variable with these cumulants exceeds 0: of a gamma distribution that is
/// shifted and scaled to them, by Wilson and Hilferty (1931).
double tail_beyond_zero(double mean, double variance, double third) {
  const double std = std::sqrt(variance);
  const double skewness = third / (variance * std);
  const double z = -mean / std;
  const auto normal_tail = [](double value) { return 0.5 * std::erfc(value / std::sqrt(2.0)); };
  if (std::abs(skewness) < 1e-3) return normal_tail(z);
  const double k = 8.0 / (skewness * skewness);  // degrees of freedom of chi²
  const double ratio = 1.0 + std::copysign(std::sqrt(2.0 / k), skewness) * z;
  const double root = std::cbrt(std::max(ratio, 0.0));
  const double as_normal = (root - (1.0 - 2.0 / (9.0 * k))) / std::sqrt(2.0 / (9.0 * k));
  return skewness > 0.0 ? normal_tail(as_normal) : normal_tail(-as_normal);
}

/// Probability that Σ λᵢ χ²ᵢ exceeds 0, each of one degree of freedom, with `zeros` more of λ = 0,
/// all less `q`: the saddlepoint approximation (Kuonen 1999), exact to a few per cent far out.
double saddlepoint_tail(const Eigen::VectorXd& eigenvalues, double zeros, double q) {
  const Eigen::ArrayXd lambda = eigenvalues.array() - q;
  double low = 0.5 / std::min(lambda.minCoeff(), -q), high = 0.5 / lambda.maxCoeff();
  low *= 1.0 - 1e-9;
  high *= 1.0 - 1e-9;
  const auto slope = [&](double at) {
    return (lambda / (1.0 - 2.0 * at * lambda)).sum() - zeros * q / (1.0 + 2.0 * at * q);
  };
  for (int step = 0; step < 200; ++step) {
    const double middle = 0.5 * (low + high);
    (slope(middle) > 0.0 ? high : low) = middle;
  }
  const double at = 0.5 * (low + high);
  const double cumulant =
      -0.5 * (1.0 - 2.0 * at * lambda).log().sum() - 0.5 * zeros * std::log(1.0 + 2.0 * at * q);
  const double curvature = 2.0 * (lambda / (1.0 - 2.0 * at * lambda)).square().sum() +
                           2.0 * zeros * std::pow(q / (1.0 + 2.0 * at * q), 2);
  const double w = std::copysign(std::sqrt(std::max(-2.0 * cumulant, 0.0)), at);
  const double v = at * std::sqrt(curvature);
  return 0.5 * std::erfc((w + std::log(v / w) / w) / std::sqrt(2.0));
}

/// The tail of `moran` by the whole spectrum: those of D'MD S, M the projection off the basis.
/// `alike`: Moran's I.
double exact_p(const Graph& graph, const Resolved& along, double alike, double dof) {
  const auto n = static_cast<Index>(graph.size());
  const auto components = static_cast<Index>(along.basis.size());
  Eigen::MatrixXd near = Eigen::MatrixXd::Zero(n * components, n * components);
  Eigen::MatrixXd basis(n * components, along.basis.front().cols());
  for (Index c = 0; c < components; ++c) {
    basis.middleRows(c * n, n) = along.basis[static_cast<std::size_t>(c)];
    for (Index i = 0; i < n; ++i) {
      for (const auto& [k, weight] : graph[static_cast<std::size_t>(i)])
        near(c * n + i, c * n + k) = weight;
    }
  }
  constexpr double kJitter = 1e-12;
  Eigen::MatrixXd free = -basis * basis.transpose();
  free.diagonal().array() += 1.0 + kJitter;
  const Eigen::MatrixXd root = free.llt().matrixL();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(root.transpose() * near * root,
                                                             Eigen::EigenvaluesOnly);
  return saddlepoint_tail(eigen.eigenvalues(), dof - static_cast<double>(n * components), alike);
}

Autocorrelation moran(const Graph& graph, const GraphSums& sums, const Resolved& along,
                      double total, double dof) {
  const Index wide = along.basis.front().cols();
  const auto components = static_cast<double>(along.basis.size());
  Eigen::MatrixXd once = Eigen::MatrixXd::Zero(wide, wide);   // B'KB
  Eigen::MatrixXd twice = Eigen::MatrixXd::Zero(wide, wide);  // B'K²B
  double thrice = 0.0, alike = 0.0;                           // tr B'K³B, e'Ke
  for (std::size_t c = 0; c < along.basis.size(); ++c) {
    const Eigen::MatrixXd near = smoothed(graph, along.basis[c]);
    once += along.basis[c].transpose() * near;
    twice += near.transpose() * near;
    thrice += near.cwiseProduct(smoothed(graph, near)).sum();
    alike += along.residual[c].dot(smoothed(graph, along.residual[c]).col(0));
  }
  const double trace = -once.trace();
  const double trace_2 =
      components * sums.squares - 2.0 * twice.trace() + once.cwiseProduct(once).sum();
  const double trace_3 = components * sums.cubes - 3.0 * thrice +
                         3.0 * twice.cwiseProduct(once).sum() -
                         (once * once).cwiseProduct(once).sum();
  const double q = alike / total;
  Autocorrelation out;
  out.moran = q;
  out.p =
      tail_beyond_zero(trace - q * dof, 2.0 * (trace_2 - 2.0 * q * trace + q * q * dof),
                       8.0 * (trace_3 - 3.0 * q * trace_2 + 3.0 * q * q * trace - q * q * q * dof));
  const double shared = (alike - total * trace / dof) / sums.weights;
  out.explained = std::max(shared, 0.0) * static_cast<double>(graph.size());
  return out;
}

}  // namespace

std::vector<Autocorrelation> test_autocorrelation(const Model& model, const Eigen::MatrixXd& basis,
                                                  double dof, const Eigen::VectorXd& weights,
                                                  int num_threads) {
  const std::vector<Eigen::MatrixXd>& contexts = model.contexts();
  const std::vector<Eigen::MatrixXd> directions = model.directions();
  const Linearization& at = model.linearization();
  std::vector<Index> tested;
  for (Index i = 0; i < weights.size(); ++i) {
    if (weights[i] > 0.0) tested.push_back(i);
  }
  const auto every = (static_cast<Index>(tested.size()) + kMaxObservations - 1) / kMaxObservations;
  std::vector<Index> kept;
  for (std::size_t i = 0; i < tested.size(); i += static_cast<std::size_t>(every))
    kept.push_back(tested[i]);
  if (static_cast<Index>(kept.size()) < kMinObservations || contexts.empty()) return {};
  std::vector<Index> place(static_cast<std::size_t>(weights.size()), -1);
  for (std::size_t i = 0; i < kept.size(); ++i)
    place[static_cast<std::size_t>(kept[i])] = static_cast<Index>(i);
  std::vector<std::vector<Index>> rows(kept.size());
  for (Index m = 0; m < at.residual.size(); ++m) {
    const int observation = at.observation[static_cast<std::size_t>(m)];
    if (observation >= 0 && place[static_cast<std::size_t>(observation)] >= 0)
      rows[static_cast<std::size_t>(place[static_cast<std::size_t>(observation)])].push_back(m);
  }
  const Eigen::VectorXd residual = at.residual - basis * (basis.transpose() * at.residual);
  const double total = residual.squaredNorm();
  std::vector<Resolved> resolved(directions.size());
  parallel_for(directions.size(), 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t d = begin; d < end; ++d)
      resolved[d] = resolve(directions[d], rows, basis, residual);
  });
  std::vector<Autocorrelation> out(contexts.size() * directions.size());
  parallel_for(contexts.size(), 1, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const Graph graph = neighbourhood(contexts[c](kept, Eigen::all));
      const GraphSums sums = sums_of(graph);
      for (std::size_t d = 0; d < directions.size(); ++d) {
        Autocorrelation& one = out[c * directions.size() + d];
        one = moran(graph, sums, resolved[d], total, dof);
        one.context = static_cast<int>(c);
        one.direction = static_cast<int>(d);
        one.p = std::min(1.0, one.p * static_cast<double>(out.size()));
        one.explained *= static_cast<double>(every);
      }
    }
  });
  const auto more_significant = [](const Autocorrelation& a, const Autocorrelation& b) {
    return std::pair(a.p, -a.explained) < std::pair(b.p, -b.explained);
  };
  std::stable_sort(out.begin(), out.end(), more_significant);
  // Three cumulants understate tails far out, up to tenfold where observations are few.
  int left = kMaxExact;
  for (Autocorrelation& one : out) {
    const Resolved& along = resolved[static_cast<std::size_t>(one.direction)];
    const Index size = static_cast<Index>(kept.size() * along.basis.size());
    if (one.p > kDoubtful || left == 0) break;
    if (one.p < kBeyondDoubt || size > kMaxExactSize) continue;
    const Graph graph =
        neighbourhood(contexts[static_cast<std::size_t>(one.context)](kept, Eigen::all));
    one.p = std::min(1.0, static_cast<double>(out.size()) * exact_p(graph, along, one.moran, dof));
    --left;
  }
  std::stable_sort(out.begin(), out.end(), more_significant);
  return out;
}

}  // namespace bathyal::selection
