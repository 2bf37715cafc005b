// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/fit_plane.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

using Matrix3 = Eigen::Matrix3d;

constexpr std::size_t kDistanceGrain = 1 << 15;
constexpr Index kMaxRanked = 2000;  // points that rank a trial; the median needs no more
constexpr double kFarthest = 1e75;  // so that fourth powers of coordinates stay finite
constexpr int kLineTrials = 50;
constexpr int kMostTrials = 1'000'000;         // half a minute; a thousand are plenty
constexpr double kMadToSigma = 1.482602218;    // of normal residuals
constexpr double kCut = 3.0;                   // sigmas within which a point is an inlier
constexpr double kCutToSigma = 1.0 / 0.98658;  // rms of normal residuals cut at 3 sigma

/// The cloud about a local origin, with the smallest residual above rounding there.
struct LocalCloud {
  PointView points;
  Vec3 origin;
  double rounding;  ///< [m]

  Vec3 at(Index i) const { return points.row(i).transpose() - origin; }
};

struct Sums {
  double n = 0.0;
  Vec3 first = Vec3::Zero();
  Matrix3 second = Matrix3::Zero();

  Sums& operator+=(const Sums& other) {
    n += other.n;
    first += other.first;
    second += other.second;
    return *this;
  }
};

/// Mean and principal axes of the points whose mask is set (all when it is empty).
struct Scatter {
  Vec3 mean = Vec3::Zero();
  Vec3 spread = Vec3::Zero();          ///< standard deviations along the axes, ascending [m]
  Matrix3 axes = Matrix3::Identity();  ///< columns
  double n = 0.0;
};

template <class Body>
Sums sum_over(const LocalCloud& cloud, const std::vector<std::uint8_t>& mask, int num_threads,
              const Body& body) {
  return parallel_sum<Sums>(static_cast<std::size_t>(cloud.points.rows()), kDistanceGrain,
                            num_threads, [&](std::size_t begin, std::size_t end) {
                              Sums sums;
                              for (std::size_t i = begin; i < end; ++i) {
                                if (mask.empty() || mask[i] != 0) {
                                  body(sums, cloud.at(static_cast<Index>(i)));
                                }
                              }
                              return sums;
                            });
}

Scatter scatter(const LocalCloud& cloud, const std::vector<std::uint8_t>& mask, int num_threads) {
  Scatter result;
  const Sums first = sum_over(cloud, mask, num_threads, [](Sums& s, const Vec3& p) {
    s.n += 1.0;
    s.first += p;
  });
  if (first.n == 0.0) return result;
  result.n = first.n;
  result.mean = first.first / first.n;
  const Sums second = sum_over(cloud, mask, num_threads, [&](Sums& s, const Vec3& p) {
    const Vec3 d = p - result.mean;
    s.second += d * d.transpose();
  });
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(second.second / first.n);
  result.spread = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  result.axes = solver.eigenvectors();
  return result;
}

/// Points that lie on one line, but for the rounding of their coordinates.
bool on_a_line(const Scatter& s, double rounding) {
  return s.spread[1] <= std::max(1e-7 * s.spread[2], rounding);
}

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// normal · (p − mean) = 0, in the local frame.
struct LocalPlane {
  Vec3 normal = Vec3::UnitZ();
  Vec3 mean = Vec3::Zero();

  double distance(const Vec3& p) const { return normal.dot(p - mean); }
};

/// The best of `trials` planes through three random points, by the median absolute residual of a
/// random part of the cloud.
LocalPlane least_median_plane(const LocalCloud& cloud, const FitPlaneOptions& options) {
  const Index n = cloud.points.rows();
  RandomStream draw(options.seed);
  const auto any = [&] {
    return std::min(n - 1, static_cast<Index>(draw.uniform() * static_cast<double>(n)));
  };
  std::vector<Vec3> ranked;
  for (Index i = 0; i < std::min(n, kMaxRanked); ++i) {
    ranked.push_back(cloud.at(n <= kMaxRanked ? i : any()));
  }
  LocalPlane best;
  double smallest = std::numeric_limits<double>::infinity();
  std::vector<double> residuals(ranked.size());
  for (int trial = 0; trial < options.trials; ++trial) {
    const Vec3 a = cloud.at(any());
    const Vec3 u = cloud.at(any()) - a;
    const Vec3 v = cloud.at(any()) - a;
    const Vec3 normal = u.cross(v);
    if (!(normal.norm() > 1e-9 * u.norm() * v.norm())) continue;
    const LocalPlane plane{normal.normalized(), a};
    for (std::size_t i = 0; i < ranked.size(); ++i) {
      residuals[i] = std::abs(plane.distance(ranked[i]));
    }
    const double median = median_of(residuals);
    if (median < smallest) {
      smallest = median;
      best = plane;
    }
  }
  // Every triple on a line or in one place: take the plane of all points.
  if (!std::isfinite(smallest)) {
    const Scatter all = scatter(cloud, {}, options.num_threads);
    best = {all.axes.col(0), all.mean};
  }
  return best;
}

std::vector<double> distances(const LocalCloud& cloud, const LocalPlane& plane, int num_threads) {
  std::vector<double> result(static_cast<std::size_t>(cloud.points.rows()));
  parallel_for(result.size(), kDistanceGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      result[i] = plane.distance(cloud.at(static_cast<Index>(i)));
    }
  });
  return result;
}

struct Refined {
  LocalPlane plane;
  Scatter inliers;
  std::vector<std::uint8_t> mask;
  std::vector<double> residuals;
};

/// Total least squares over the points within 3 sigma, until these no longer change.
Refined refine_plane(const LocalCloud& cloud, LocalPlane plane, const FitPlaneOptions& options) {
  Refined result;
  double sigma = 0.0;
  for (int round = 0; round < 50; ++round) {
    std::vector<double> residuals = distances(cloud, plane, options.num_threads);
    if (round == 0) {
      std::vector<double> sizes(residuals.size());
      std::transform(residuals.begin(), residuals.end(), sizes.begin(),
                     [](double r) { return std::abs(r); });
      sigma = kMadToSigma * median_of(sizes);
    }
    const double cut = std::max(kCut * sigma, cloud.rounding);
    std::vector<std::uint8_t> mask(residuals.size());
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = std::abs(residuals[i]) <= cut;
    const bool settled = mask == result.mask;
    result.residuals = std::move(residuals);
    if (settled) break;
    result.mask = std::move(mask);
    result.inliers = scatter(cloud, result.mask, options.num_threads);
    plane = {result.inliers.axes.col(0), result.inliers.mean};
    sigma = kCutToSigma * result.inliers.spread[0];
    result.plane = plane;
  }
  return result;
}

/// Refuses inliers that lie on one line but for fewer than one in ten: any plane through that line
/// would do. (Of three points, two are always on a line.)
void check_not_on_a_line(const LocalCloud& cloud, const Refined& fit, std::uint64_t seed) {
  std::vector<Vec3> points;
  RandomStream draw(seed, 1);
  const auto size = static_cast<double>(cloud.points.rows());
  const double keep = static_cast<double>(kMaxRanked) / fit.inliers.n;
  for (std::size_t i = 0; i < fit.mask.size(); ++i) {
    if (fit.mask[i] != 0 && draw.uniform() < keep)
      points.push_back(cloud.at(static_cast<Index>(i)));
  }
  const auto any = [&] {
    return points[static_cast<std::size_t>(draw.uniform() * static_cast<double>(points.size()))];
  };
  const double near = std::max(1e-7 * fit.inliers.spread[2], cloud.rounding);
  for (int trial = 0; trial < kLineTrials; ++trial) {
    const Vec3 a = any();
    const Vec3 along = any() - a;
    if (along.norm() <= near) continue;
    const auto on_line = std::count_if(points.begin(), points.end(), [&](const Vec3& p) {
      return along.cross(p - a).norm() <= near * along.norm();
    });
    if (static_cast<double>(on_line) > 0.9 * static_cast<double>(points.size())) {
      throw_argument("points", "a plane that points off one line agree on",
                     "over 90 % of the " + to_text(fit.inliers.n) + " inliers of " + to_text(size) +
                         " points on one line");
    }
  }
}

/// From the residuals: the least eigenvalue of the scatter keeps only half of their digits.
double rms_of_inliers(const Refined& fit) {
  double sum = 0.0;
  for (std::size_t i = 0; i < fit.mask.size(); ++i) {
    if (fit.mask[i] != 0) sum += fit.residuals[i] * fit.residuals[i];
  }
  return std::sqrt(sum / fit.inliers.n);
}

Vec3 turned_up(const Vec3& normal) {
  for (const int axis : {2, 0, 1}) {
    if (std::abs(normal[axis]) > 1e-12) return normal[axis] > 0.0 ? normal : Vec3(-normal);
  }
  return normal;
}

/// One number for the square (floor u, floor v). Squares 2³⁰ sides away share the outermost: only
/// single gross errors lie there.
std::uint64_t patch_key(double u, double v) {
  const auto index = [](double w) {
    return static_cast<std::uint32_t>(
        static_cast<std::int32_t>(std::clamp(std::floor(w), -0x1p30, 0x1p30)));
  };
  return std::uint64_t{index(u)} << 32U | index(v);
}

/// Distances of the patches' medians from the plane [m].
std::vector<double> patch_distances(const LocalCloud& cloud, const Refined& fit, int patch_points) {
  const auto n = static_cast<double>(cloud.points.rows());
  std::vector<double> result;
  if (n < 2.0 * patch_points) {
    for (const double r : fit.residuals) result.push_back(std::abs(r));
    return result;
  }
  // Patches lie along the plane's own two axes; the inliers, spread as if evenly over a rectangle
  // (width = √12 standard deviations), give the density.
  const Vec3& spread = fit.inliers.spread;
  const double side = std::sqrt(12.0 * spread[1] * spread[2] * patch_points / fit.inliers.n);
  std::unordered_map<std::uint64_t, std::vector<double>> patches;
  for (Index i = 0; i < cloud.points.rows(); ++i) {
    const Vec3 d = cloud.at(i) - fit.plane.mean;
    patches[patch_key(d.dot(fit.inliers.axes.col(1)) / side, d.dot(fit.inliers.axes.col(2)) / side)]
        .push_back(fit.residuals[static_cast<std::size_t>(i)]);
  }
  for (auto& [at, residuals] : patches) {
    // A patch cut by the rim of the cloud has too few points for a useful median.
    if (static_cast<double>(residuals.size()) < 0.5 * patch_points) continue;
    result.push_back(std::abs(median_of(residuals)));
  }
  return result;
}

void judge_flatness(const LocalCloud& cloud, const Refined& refined, const FitPlaneOptions& options,
                    PlaneFit& fit) {
  const std::vector<double> patches = patch_distances(cloud, refined, options.patch_points);
  if (patches.empty()) return;
  const auto within = std::count_if(patches.begin(), patches.end(),
                                    [&](double d) { return d <= options.tolerance; });
  fit.flat_share = static_cast<double>(within) / static_cast<double>(patches.size());
  fit.relief = *std::max_element(patches.begin(), patches.end());
  fit.flat = fit.flat_share >= options.flat_share;
}

}  // namespace

void FitPlaneOptions::check() const {
  check_positive("tolerance", tolerance);
  if (patch_points < 5) throw_argument("patch_points", "5 or more", std::to_string(patch_points));
  check_positive("flat_share", flat_share);
  check_range("flat_share", flat_share, 0.0, 1.0);
  check_range("trials", trials, 1, kMostTrials);
  resolve_threads(num_threads);
}

PlaneFit fit_plane(PointView points, const FitPlaneOptions& options) {
  options.check();
  check_points_finite("points", points);
  if (points.rows() < 3) {
    throw_argument("points", "three points or more", std::to_string(points.rows()));
  }
  const double largest = points.cwiseAbs().maxCoeff();
  if (largest > kFarthest) {
    throw_argument("points", "coordinates of 1e75 at most", to_text(largest));
  }
  const LocalCloud cloud{points, local_origin(points),
                         8.0 * std::numeric_limits<double>::epsilon() * largest};
  const Scatter all = scatter(cloud, {}, options.num_threads);
  if (on_a_line(all, cloud.rounding)) {
    throw_argument("points", "three points or more that are not on one line",
                   std::to_string(points.rows()) + " points on one line or in one place");
  }

  const Refined refined = refine_plane(cloud, least_median_plane(cloud, options), options);
  check_not_on_a_line(cloud, refined, options.seed);
  PlaneFit fit;
  const Vec3 normal = turned_up(refined.plane.normal);
  fit.plane = Plane::through(refined.plane.mean + cloud.origin, normal);
  fit.rms = rms_of_inliers(refined);
  fit.inliers = refined.mask;
  fit.inlier_count = static_cast<Index>(refined.inliers.n);
  fit.tilt_std = fit.rms / (std::sqrt(refined.inliers.n) * refined.inliers.spread[1]);
  judge_flatness(cloud, refined, options, fit);
  return fit;
}

}  // namespace bathyal
