// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/compensation/support.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

/// Rounding of poses in files and of solutions does not place them outside the support.
constexpr double kRounding = 1e-9;

Support::Range range_of(const RowMatrix& values) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Support::Range range{Eigen::VectorXd::Constant(values.cols(), kInfinity),
                       Eigen::VectorXd::Constant(values.cols(), -kInfinity)};
  for (Index i = 0; i < values.rows(); ++i) {
    for (Index j = 0; j < values.cols(); ++j) {
      if (std::isnan(values(i, j))) continue;
      range.low[j] = std::min(range.low[j], values(i, j));
      range.high[j] = std::max(range.high[j], values(i, j));
    }
  }
  return range;
}

/// Neighbours farther apart than a share of the range; smaller gaps matter to no effect.
std::vector<Support::Gap> gaps_of(const Eigen::VectorXd& values) {
  constexpr double kLeastShare = 1.0 / 200.0;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<Support::Gap> gaps;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double width = sorted[i] - sorted[i - 1];
    if (width > kLeastShare * (sorted.back() - sorted.front())) {
      gaps.push_back({sorted[i - 1], sorted[i]});
    }
  }
  return gaps;
}

bool known(const Support::Range& range) { return (range.low.array() <= range.high.array()).all(); }

void check_range_of(const std::string& name, const Support::Range& range, Index width) {
  const bool fits = range.low.size() == range.high.size() &&
                    (width < 0 ? range.low.size() > 0 : range.low.size() == width);
  if (!fits) {
    throw_argument("support " + name,
                   width < 0 ? "as many lows as highs" : std::to_string(width) + " lows and highs",
                   std::to_string(range.low.size()) + " and " + std::to_string(range.high.size()));
  }
  if (!range.low.allFinite() || !range.high.allFinite() || !known(range)) {
    throw_argument("support " + name, "finite numbers, each low no more than its high", "others");
  }
}

/// (N, k) numbers of a covariate, a single row replicated.
RowMatrix replicated(const std::string& name, const RowMatrix& values, Index rows, Index columns) {
  if (values.rows() != rows && values.rows() != 1) {
    throw_argument("covariates " + name, std::to_string(rows) + " rows, one a pose, or one row",
                   std::to_string(values.rows()));
  }
  if (columns > 0 && values.cols() != columns) {
    throw_argument("covariates " + name, std::to_string(columns) + " columns",
                   std::to_string(values.cols()));
  }
  if (values.array().isInf().any()) {
    throw_argument("covariates " + name, "finite numbers, or NaN where it is not known", "inf");
  }
  return values.rows() == rows ? values : RowMatrix(values.replicate(rows, 1));
}

/// Clamps one table to its range, in all three.
class Bounds {
 public:
  explicit Bounds(bool& beyond) : beyond_(beyond) {}

  void within(const Support::Range& range, RowMatrix& query, RowMatrix& low, RowMatrix& high) {
    low = high = query;
    for (Index j = 0; j < query.cols(); ++j) {
      const double slack = kRounding * (1.0 + range.high[j] - range.low[j]);
      for (Index i = 0; i < query.rows(); ++i) {
        const double value = query(i, j);
        if (value >= range.low[j] - slack && value <= range.high[j] + slack) continue;
        beyond_ = true;
        if (std::isnan(value)) {
          // A range of zero width would hide that the effect depends on it.
          const double width = range.high[j] - range.low[j];
          query(i, j) = low(i, j) = range.low[j];
          high(i, j) = range.low[j] + (width > 0.0 ? width : 1.0);
        } else {
          low(i, j) = high(i, j) = std::clamp(value, range.low[j], range.high[j]);
        }
      }
    }
  }

  void within(const std::vector<double>& sessions, RowMatrix& query, RowMatrix& low,
              RowMatrix& high) {
    low = high = query;
    for (Index i = 0; i < query.size(); ++i) {
      const double value = query.data()[i];
      const bool known = !std::isnan(value);
      if (known && std::binary_search(sessions.begin(), sessions.end(), value)) continue;
      beyond_ = true;
      if (!known) query.data()[i] = sessions.front();
      low.data()[i] = sessions.front();
      high.data()[i] = sessions.back();
    }
  }

 private:
  bool& beyond_;
};

}  // namespace

bool is_library_covariate(std::string_view name) {
  constexpr std::array<std::string_view, 7> kNames{"temperature", "time",    "payload", "direction",
                                                   "gravity",     "session", "row"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

Covariates used_covariates(const EffectData& data) {
  Covariates out = data.covariates;
  std::erase_if(out, [&data](const auto& covariate) {
    return is_library_covariate(covariate.first) && !data.has(covariate.first);
  });
  return out;
}

void Support::check(Index coordinates) const {
  check_range_of("joints", joints, coordinates);
  check_range_of("gravity", gravity, 3);
  for (const auto& [name, range] : covariates) check_range_of(name, range, -1);
  if (!gaps.empty() && static_cast<Index>(gaps.size()) != coordinates) {
    throw_argument("support gaps", "a list for each of " + std::to_string(coordinates) + " joints",
                   std::to_string(gaps.size()));
  }
  for (std::size_t j = 0; j < gaps.size(); ++j) {
    double end = joints.low[static_cast<Index>(j)];
    for (const Gap& gap : gaps[j]) {
      if (!(end <= gap.low && gap.low < gap.high &&
            gap.high <= joints.high[static_cast<Index>(j)])) {
        throw_argument("support gaps",
                       "stretches that rise within their joint's range, each low below its high",
                       "others, of joint " + std::to_string(j + 1));
      }
      end = gap.high;
    }
  }
  const bool rising = std::adjacent_find(sessions.begin(), sessions.end(),
                                         std::greater_equal<>()) == sessions.end();
  if (!rising || !std::all_of(sessions.begin(), sessions.end(),
                              [](double session) { return std::isfinite(session); })) {
    throw_argument("support sessions", "finite numbers that rise", "others");
  }
}

std::vector<Support::Gap> Support::gaps_wider_than(double period, Index joint) const {
  if (gaps.empty()) return {};
  std::vector<Gap> wide = gaps[static_cast<std::size_t>(joint)];
  std::erase_if(wide, [&](const Gap& gap) { return gap.high - gap.low <= period; });
  return wide;
}

bool Support::leave_gaps(double period, RowMatrix& q) const {
  bool moved = false;
  for (Index j = 0; j < q.cols(); ++j) {
    const std::vector<Gap> wide = gaps_wider_than(period, j);
    for (double& value : q.col(j)) {
      const auto after = std::upper_bound(wide.begin(), wide.end(), value,
                                          [](double v, const Gap& gap) { return v < gap.low; });
      if (after == wide.begin()) continue;
      const Gap& gap = *std::prev(after);
      if (std::min(value - gap.low, gap.high - value) <= kRounding) continue;
      value = value - gap.low < gap.high - value ? gap.low : gap.high;
      moved = true;
    }
  }
  return moved;
}

Eigen::ArrayXd Support::edge_weights(const Eigen::Ref<const Eigen::ArrayXd>& values,
                                     const Eigen::Ref<const Eigen::ArrayXd>& edges, double period,
                                     Index joint) const {
  const std::vector<Gap> wide = gaps_wider_than(period, joint);
  Eigen::ArrayXd weights = Eigen::ArrayXd::Ones(values.size());
  for (Index i = 0; i < values.size(); ++i) {
    const double beyond = std::abs(values[i] - edges[i]);
    if (beyond == 0.0) continue;
    // The stretch of training data that ends at the edge lies between two gaps.
    const auto next = std::lower_bound(wide.begin(), wide.end(), edges[i],
                                       [](const Gap& gap, double edge) { return gap.low < edge; });
    const double low = next == wide.begin() ? joints.low[joint] : std::prev(next)->high;
    const double high = next == wide.end() ? joints.high[joint] : next->low;
    weights[i] = std::max(1.0 - beyond / std::min(0.5 * period, high - low), 0.0);
  }
  return weights;
}

Eigen::VectorXd Support::training_values(Index joint, double period, Index count) const {
  const std::vector<Gap> wide = gaps_wider_than(period, joint);
  double width = joints.high[joint] - joints.low[joint];
  for (const Gap& gap : wide) width -= gap.high - gap.low;
  Eigen::VectorXd values(count);
  auto gap = wide.begin();
  double skipped = 0.0;
  for (Index i = 0; i < count; ++i) {
    const double along = width * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    while (gap != wide.end() && joints.low[joint] + along + skipped > gap->low) {
      skipped += gap->high - gap->low;
      ++gap;
    }
    values[i] = joints.low[joint] + along + skipped;
  }
  return values;
}

Support support_of(const RowMatrix& q, const Covariates& covariates) {
  Support support;
  support.joints = range_of(q);
  for (Index j = 0; j < q.cols(); ++j) support.gaps.push_back(gaps_of(q.col(j)));
  support.gravity = {kGravity, kGravity};
  support.covariates["payload"] = {Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1)};
  for (const auto& [name, values] : covariates) {
    if (name == "session") {
      std::set<double> seen;
      for (Index i = 0; i < values.size(); ++i) {
        if (!std::isnan(values.data()[i])) seen.insert(values.data()[i]);
      }
      support.sessions.assign(seen.begin(), seen.end());
      continue;
    }
    Support::Range range = range_of(values);
    if (!known(range)) continue;
    if (name == "gravity") {
      support.gravity = std::move(range);
    } else {
      support.covariates[name] = std::move(range);
    }
  }
  return support;
}

QueryRows clamp_to_support(const Arm& arm, const Support& support, const RowMatrix& q,
                           const Covariates& covariates) {
  QueryRows rows;
  const Index count = q.rows();
  Covariates given{{"payload", RowMatrix::Zero(count, 1)}};
  for (const auto& [name, values] : covariates) {
    const auto known_range = support.covariates.find(name);
    const Index columns = name == "gravity"   ? 3
                          : name == "session" ? 1
                          : known_range == support.covariates.end()
                              ? 0
                              : known_range->second.low.size();
    given[name] = replicated(name, values, count, columns);
  }
  EffectData& query = rows.query;
  query = make_effect_data(arm, q, given, false);
  query.recording = false;
  // Row by row: rows in which it is unknown are clamped to its range below.
  if (given.contains("gravity")) query.gravity = given.at("gravity");

  rows.low = rows.high = query;
  Bounds bounds(rows.beyond);
  bounds.within(support.joints, query.q, rows.low.q, rows.high.q);
  bounds.within(support.gravity, query.gravity, rows.low.gravity, rows.high.gravity);
  for (auto& [name, values] : query.covariates) {
    RowMatrix& low = rows.low.covariates[name];
    RowMatrix& high = rows.high.covariates[name];
    const auto known_range = support.covariates.find(name);
    if (name == "gravity") {
      values = query.gravity;
      low = rows.low.gravity;
      high = rows.high.gravity;
    } else if (name == "session" && !support.sessions.empty()) {
      bounds.within(support.sessions, values, low, high);
    } else if (known_range != support.covariates.end()) {
      bounds.within(known_range->second, values, low, high);
    }
  }
  return rows;
}

}  // namespace bathyal
