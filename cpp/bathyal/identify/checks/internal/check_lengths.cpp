// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "bathyal/base/text.hpp"
#include "bathyal/identify/checks/internal/checks.hpp"

namespace bathyal {
namespace {

using Warnings = std::vector<std::string>;

/// "50.1 mm from left to right": neighbours by label, the first three.
std::string distances_found(const Measurement& m, const ArmFit& fit) {
  std::vector<std::string> texts;
  const auto count = static_cast<Index>(fit.point_labels.size());
  for (Index p = 0; p + 1 < count && texts.size() < 3; ++p) {
    texts.push_back(millimetres((fit.points.col(p) - fit.points.col(p + 1)).norm()) + " from " +
                    m.name_of(fit.point_labels[p]) + " to " + m.name_of(fit.point_labels[p + 1]));
  }
  return listed(texts);
}

void doubt_size_untold(const Case& seen, Warnings& warnings) {
  constexpr double kLoosePrior = 3e-3;  // [m] more than makers allow themselves
  constexpr double kShrunk = 0.01;
  const ArmFit& fit = seen.fit;
  std::string text =
      "Nothing measured tells the arm's size: a smaller arm would agree with itself even better, "
      "so that a smaller rms proves nothing. The " +
      fit.scale_source + " set the size";
  if (is_unusable(seen)) {
    warnings.push_back(text +
                       ". Measure a distance between touched points, and give it as "
                       "known_distances.");
    return;
  }
  const std::string distances = distances_found(seen.measurement, fit);
  text += "; rms " + millimetres(fit.rms_after) + " is " + millimetres(fit.rms_after_scaled) +
          " at the nominal size. ";
  text += distances.empty() ? "Touch a second point at a measured distance from the first, and "
                              "give it as known_distances."
                            : "By this fit the points lie " + distances +
                                  " apart: measure one such distance and give it as "
                                  "known_distances.";
  warnings.push_back(std::move(text));
  double loosest = 0.0;
  for (std::size_t i = 0; i < fit.columns.columns.size(); ++i) {
    const double std = fit.columns.columns[i].prior_std;
    if (is_length(fit.columns.places[i]) && std != Column::kNoPrior) {
      loosest = std::max(loosest, std);
    }
  }
  if (loosest <= kLoosePrior && std::abs(fit.scale - 1.0) < kShrunk) return;
  warnings.push_back("The arm came out at " + three_digits(fit.scale) +
                     " times its nominal size with lengths held to " + millimetres(loosest) +
                     " only; a looser prior would shrink it further. Set the maker's tolerance, "
                     "about 1 mm, as length_prior.");
}

void doubt_size_told(const Case& seen, Warnings& warnings) {
  constexpr double kMostStretch = 0.02;
  const ArmFit& fit = seen.fit;
  const double stretch = std::abs(fit.scale - 1.0);
  if (is_unusable(seen) || is_swamped(seen)) return;
  if (stretch < kMostStretch || stretch < 3.0 * fit.scale_std) return;
  warnings.push_back("By the " + fit.scale_source + " the arm is " + three_digits(fit.scale) +
                     " times its nominal size (± " + three_digits(fit.scale_std) +
                     "), which no maker misses by so much: a told length or its unit is wrong, "
                     "the arm is another one, or more than geometry is at work.");
}

/// Std of a point's centre per axis, from its touches alone.
std::vector<double> center_std(const Measurement& m, double noise) {
  std::vector<double> total(static_cast<std::size_t>(m.points()), 0.0);
  for (Index i = 0; i < m.rows(); ++i) {
    if (m.point[i] >= 0) total[m.point[i]] += m.weights[i];
  }
  for (double& value : total) value = noise / std::sqrt(value);
  return total;
}

/// A length that was told: a distance, or what two known points are apart.
struct ToldLength {
  int first = 0;  ///< indices of points
  int second = 0;
  double length = 0.0;
};

std::vector<ToldLength> told_lengths(const Measurement& m) {
  std::vector<ToldLength> told;
  for (const KnownDistance& known : m.distances) {
    told.push_back({known.first, known.second, known.distance});
  }
  for (std::size_t a = 0; a < m.known_points.size(); ++a) {
    for (std::size_t b = a + 1; b < m.known_points.size(); ++b) {
      const KnownPoint& first = m.known_points[a];
      const KnownPoint& second = m.known_points[b];
      told.push_back({first.label, second.label, (first.position - second.position).norm()});
    }
  }
  return told;
}

/// Told lengths that the touches alone contradict, with points a and b changed for each other.
std::vector<ToldLength> contradicted(const std::vector<ToldLength>& told,
                                     const Eigen::Matrix3Xd& points, int a, int b) {
  constexpr double kShare = 0.03;  // the arm's size, and with it all, is known no better
  constexpr double kLeast = 3e-3;  // [m]
  const auto swap = [a, b](int p) { return p == a ? b : p == b ? a : p; };
  std::vector<ToldLength> wrong;
  for (const ToldLength& length : told) {
    const double found = (points.col(swap(length.first)) - points.col(swap(length.second))).norm();
    if (std::abs(found - length.length) > kShare * length.length + kLeast) wrong.push_back(length);
  }
  return wrong;
}

/// The two points that told and touched lengths agree about once they are changed for each other.
std::string swapped_points(const std::vector<ToldLength>& told, const Measurement& m,
                           const Eigen::Matrix3Xd& points) {
  if (told.size() < 2) return "";  // one length agrees with some pair by chance
  for (int a = 0; a < m.points(); ++a) {
    for (int b = a + 1; b < m.points(); ++b) {
      if (contradicted(told, points, a, b).empty()) {
        return " Changed for each other, points " + m.name_of(m.labels[a]) + " and " +
               m.name_of(m.labels[b]) + " agree with it: their labels look swapped.";
      }
    }
  }
  return "";
}

/// Far off: by the touches without what was told, for a fit bends to it.
std::string gross_contradiction(const Case& seen) {
  const Measurement& m = seen.measurement;
  const Eigen::Matrix3Xd& points = seen.search.points;
  if (!seen.search.looked_twice || seen.search.hopeless) return "";
  const std::vector<ToldLength> told = told_lengths(m);
  std::vector<std::string> texts;
  for (const ToldLength& wrong : contradicted(told, points, 0, 0)) {
    texts.push_back("from " + m.name_of(m.labels[wrong.first]) + " to " +
                    m.name_of(m.labels[wrong.second]) + " told as " + millimetres(wrong.length) +
                    ", touched as " +
                    millimetres((points.col(wrong.first) - points.col(wrong.second)).norm()));
  }
  if (texts.empty()) return "";
  return listed(texts, 4) + "." + swapped_points(told, m, points);
}

/// Of the noise's size: what is left between told and found.
std::string fine_contradiction(const Case& seen) {
  constexpr double kMostSigma = 4.0;
  const Measurement& m = seen.measurement;
  const std::vector<double> center = center_std(m, seen.fit.noise);
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < m.distances.size(); ++k) {
    const KnownDistance& known = m.distances[k];
    const FoundDistance& found = seen.fit.distances[k];
    const double std =
        std::hypot(m.distance_std, std::hypot(center[known.first], center[known.second]));
    if (std::abs(found.found - found.told) < kMostSigma * std) continue;
    texts.push_back("from " + m.name_of(found.first) + " to " + m.name_of(found.second) +
                    " told as " + millimetres(found.told) + ", found as " +
                    millimetres(found.found));
  }
  for (const KnownPoint& known : m.known_points) {
    const double away = (seen.fit.points.col(known.label) - known.position).norm();
    const double std = std::hypot(m.point_std, center[known.label]);
    if (away < kMostSigma * std::sqrt(3.0) * std) continue;
    texts.push_back("point " + m.name_of(m.labels[known.label]) + " found " + millimetres(away) +
                    " from where it was told");
  }
  return texts.empty() ? "" : listed(texts, 4) + ".";
}

void doubt_told(const Case& seen, Warnings& warnings) {
  std::string text = gross_contradiction(seen);
  if (text.empty() && !is_swamped(seen)) text = fine_contradiction(seen);
  if (text.empty()) return;
  warnings.push_back("The touches contradict what was told: " + text +
                     " Measure again, or tell how surely it is known (distance_std, point_std).");
}

}  // namespace

void doubt_lengths(const Case& seen, Warnings& warnings) {
  if (seen.measurement.tells_scale()) {
    doubt_size_told(seen, warnings);
  } else {
    doubt_size_untold(seen, warnings);
  }
  doubt_told(seen, warnings);
}

}  // namespace bathyal
