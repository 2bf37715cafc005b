// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "bathyal/base/text.hpp"
#include "bathyal/identify/checks/internal/checks.hpp"

namespace bathyal::identify {
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

void check_unobserved_scale(const CheckContext& context, Warnings& warnings) {
  const ArmFit& fit = context.fit;
  std::string text =
      "No measurement determines the scale of the arm: a smaller arm would agree with itself even "
      "better, so that a smaller rms proves nothing. The " +
      fit.scale_source + " determines it";
  if (is_unusable(context)) {
    warnings.push_back(text +
                       ". Measure a distance between touched points, and give it as "
                       "known_distances.");
    return;
  }
  const std::string distances = distances_found(context.measurement, fit);
  text += "; rms " + millimetres(fit.rms_after) + " is " + millimetres(fit.rms_after_scaled) +
          " at the nominal scale. ";
  text += distances.empty() ? "Touch a second point at a measured distance from the first, and "
                              "give it as known_distances."
                            : "By this fit the points lie " + distances +
                                  " apart: measure one such distance and give it as "
                                  "known_distances.";
  warnings.push_back(std::move(text));
  double loosest = 0.0;
  for (std::size_t i = 0; i < fit.arm_parameters.parameters.size(); ++i) {
    const double std = fit.arm_parameters.parameters[i].prior_std;
    if (is_length(fit.arm_parameters.slots[i]) && std != Parameter::kNoPrior) {
      loosest = std::max(loosest, std);
    }
  }
  if (loosest <= Limits::kLoosePrior && std::abs(fit.scale - 1.0) < Limits::kShrunk) return;
  warnings.push_back("The arm came out at " + three_digits(fit.scale) +
                     " times its nominal size with lengths constrained to " + millimetres(loosest) +
                     " only; a looser prior would shrink it further. Set the maker's tolerance, "
                     "about 1 mm, as length_prior.");
}

void check_observed_scale(const CheckContext& context, Warnings& warnings) {
  const ArmFit& fit = context.fit;
  const double stretch = std::abs(fit.scale - 1.0);
  if (is_unusable(context) || outliers_dominate(context)) return;
  if (stretch < Limits::kMostStretch || stretch < 3.0 * fit.scale_std) return;
  warnings.push_back("By the " + fit.scale_source + " the arm is " + three_digits(fit.scale) +
                     " times its nominal size (± " + three_digits(fit.scale_std) +
                     "), which no maker misses by so much: a given length or its unit is wrong, "
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

/// A given length: a known distance, or the distance of two known points.
struct GivenLength {
  int first = 0;  ///< indices of points
  int second = 0;
  double length = 0.0;
};

std::vector<GivenLength> given_lengths(const Measurement& m) {
  std::vector<GivenLength> given;
  for (const KnownDistance& known : m.distances) {
    given.push_back({known.first, known.second, known.distance});
  }
  for (std::size_t a = 0; a < m.known_points.size(); ++a) {
    for (std::size_t b = a + 1; b < m.known_points.size(); ++b) {
      const KnownPoint& first = m.known_points[a];
      const KnownPoint& second = m.known_points[b];
      given.push_back({first.label, second.label, (first.position - second.position).norm()});
    }
  }
  return given;
}

/// Given lengths that the touches alone contradict, with points a and b exchanged.
std::vector<GivenLength> contradicted(const std::vector<GivenLength>& given,
                                      const Eigen::Matrix3Xd& points, int a, int b) {
  const auto swap = [a, b](int p) { return p == a ? b : p == b ? a : p; };
  std::vector<GivenLength> wrong;
  for (const GivenLength& length : given) {
    const double found = (points.col(swap(length.first)) - points.col(swap(length.second))).norm();
    if (std::abs(found - length.length) >
        Limits::kLengthShare * length.length + Limits::kLengthLeast)
      wrong.push_back(length);
  }
  return wrong;
}

/// The two points whose exchange makes given and touched lengths agree.
std::string swapped_points(const std::vector<GivenLength>& given, const Measurement& m,
                           const Eigen::Matrix3Xd& points) {
  if (given.size() < 2) return "";  // one length agrees with some pair by chance
  for (int a = 0; a < m.points(); ++a) {
    for (int b = a + 1; b < m.points(); ++b) {
      if (contradicted(given, points, a, b).empty()) {
        return " With their labels exchanged, points " + m.name_of(m.labels[a]) + " and " +
               m.name_of(m.labels[b]) + " agree with it: their labels look swapped.";
      }
    }
  }
  return "";
}

/// Gross errors: by the touches without the given lengths, which would bias the fit.
std::string gross_contradiction(const CheckContext& context) {
  const Measurement& m = context.measurement;
  const Eigen::Matrix3Xd& points = context.search.points;
  if (!context.search.refitted || context.search.no_consensus) return "";
  const std::vector<GivenLength> given = given_lengths(m);
  std::vector<std::string> texts;
  for (const GivenLength& wrong : contradicted(given, points, 0, 0)) {
    texts.push_back("from " + m.name_of(m.labels[wrong.first]) + " to " +
                    m.name_of(m.labels[wrong.second]) + " given as " + millimetres(wrong.length) +
                    ", touched as " +
                    millimetres((points.col(wrong.first) - points.col(wrong.second)).norm()));
  }
  if (texts.empty()) return "";
  return listed(texts, 4) + "." + swapped_points(given, m, points);
}

/// Errors of the size of the noise: estimated against given lengths.
std::string fine_contradiction(const CheckContext& context) {
  const Measurement& m = context.measurement;
  const std::vector<double> center = center_std(m, context.fit.noise);
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < m.distances.size(); ++k) {
    const KnownDistance& known = m.distances[k];
    const DistanceComparison& found = context.fit.distances[k];
    const double std =
        std::hypot(m.distance_std, std::hypot(center[known.first], center[known.second]));
    if (std::abs(found.estimated - found.given) < Limits::kLengthSigma * std) continue;
    texts.push_back("from " + m.name_of(found.first) + " to " + m.name_of(found.second) +
                    " given as " + millimetres(found.given) + ", estimated as " +
                    millimetres(found.estimated));
  }
  for (const KnownPoint& known : m.known_points) {
    const double away = (context.fit.points.col(known.label) - known.position).norm();
    const double std = std::hypot(m.point_std, center[known.label]);
    if (away < Limits::kLengthSigma * std::sqrt(3.0) * std) continue;
    texts.push_back("point " + m.name_of(m.labels[known.label]) + " found " + millimetres(away) +
                    " from the given position");
  }
  return texts.empty() ? "" : listed(texts, 4) + ".";
}

void check_given_lengths(const CheckContext& context, Warnings& warnings) {
  std::string text = gross_contradiction(context);
  if (text.empty() && !outliers_dominate(context)) text = fine_contradiction(context);
  if (text.empty()) return;
  warnings.push_back("The touches contradict the given lengths: " + text +
                     " Measure again, or give its uncertainty (distance_std, point_std).");
}

}  // namespace

void check_lengths(const CheckContext& context, Warnings& warnings) {
  if (context.measurement.observes_scale()) {
    check_observed_scale(context, warnings);
  } else {
    check_unobserved_scale(context, warnings);
  }
  check_given_lengths(context, warnings);
}

}  // namespace bathyal::identify
