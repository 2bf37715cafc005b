// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/clean_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/soundings/internal/clean_steps.hpp"
#include "bathyal/soundings/internal/parallel_sort.hpp"

namespace bathyal {
namespace {

using namespace soundings;

constexpr std::size_t kGrain = std::size_t{1} << 14U;

Soundings finite_soundings(PointView points) {
  Soundings soundings;
  soundings.reserve(static_cast<std::size_t>(points.rows()));
  for (Index i = 0; i < points.rows(); ++i) {
    const double* p = points.data() + 3 * i;
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) {
      soundings.push_back({p[0], p[1], p[2], static_cast<std::int32_t>(i)});
    }
  }
  return soundings;
}

void put_in_canonical_order(Soundings& soundings, int num_threads) {
  parallel_sort(
      soundings,
      [](const Sounding& a, const Sounding& b) {
        if (a.x != b.x) return a.x < b.x;
        if (a.y != b.y) return a.y < b.y;
        if (a.z != b.z) return a.z < b.z;
        return a.row < b.row;
      },
      num_threads);
}

/// Removes what is marked and returns how much that was.
Index drop(Soundings& soundings, const Marks& marks) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < soundings.size(); ++i) {
    if (marks[i] == 0) soundings[kept++] = soundings[i];
  }
  const auto dropped = static_cast<Index>(soundings.size() - kept);
  soundings.resize(kept);
  return dropped;
}

bool at_one_place(const Sounding& a, const Sounding& b) { return a.x == b.x && a.y == b.y; }

/// Equal soundings are consecutive, the first row in front.
Marks mark_duplicates(const Soundings& soundings) {
  Marks marks(soundings.size(), 0);
  for (std::size_t i = 1; i < soundings.size(); ++i) {
    const bool same = at_one_place(soundings[i], soundings[i - 1]);
    marks[i] = same && soundings[i].z == soundings[i - 1].z ? 1 : 0;
  }
  return marks;
}

/// Counts soundings that share their place, and marks those that the rule drops; they are
/// consecutive, from the lowest to the highest.
Marks mark_same_place(const Soundings& soundings, SamePlace rule, Index& count) {
  Marks marks(soundings.size(), 0);
  for (std::size_t begin = 0, end = 0; begin < soundings.size(); begin = end) {
    end = begin + 1;
    while (end < soundings.size() && at_one_place(soundings[begin], soundings[end])) ++end;
    if (end - begin == 1) continue;
    count += static_cast<Index>(end - begin);
    if (rule == SamePlace::kKeep) continue;
    const std::size_t chosen = rule == SamePlace::kDeepest ? begin : end - 1;
    for (std::size_t i = begin; i < end; ++i) marks[i] = i != chosen ? 1 : 0;
  }
  return marks;
}

Indices rows_in_order(const Soundings& soundings, int num_threads) {
  std::vector<std::int32_t> rows(soundings.size());
  std::transform(soundings.begin(), soundings.end(), rows.begin(),
                 [](const Sounding& sounding) { return sounding.row; });
  parallel_sort(rows, std::less<>(), num_threads);
  return Indices::Matrix(
      Eigen::Map<const Indices::Matrix>(rows.data(), static_cast<Index>(rows.size())));
}

/// The chosen rows of the cloud; the cloud itself when those are all.
PointCloud take_rows(const PointCloud& cloud, const Indices& rows, int num_threads) {
  if (rows.rows() == cloud.size()) return cloud;
  PointMatrix points(rows.rows(), 3);
  const auto for_rows = [&](const auto& copy) {
    parallel_for(static_cast<std::size_t>(rows.rows()), kGrain, num_threads,
                 [&](std::size_t begin, std::size_t end) {
                   for (auto i = static_cast<Index>(begin); i < static_cast<Index>(end); ++i) {
                     copy(i, static_cast<Index>(rows.data()[i]));
                   }
                 });
  };
  for_rows([&](Index to, Index from) { points.row(to) = cloud.points().row(from); });
  Attributes attributes;
  for (const auto& [name, values] : cloud.attributes()) {
    Values::Matrix taken(rows.rows());
    for_rows(
        [&, from_values = values.data()](Index to, Index from) { taken(to) = from_values[from]; });
    attributes.emplace(name, std::move(taken));
  }
  return PointCloud(std::move(points), std::move(attributes), cloud.datum());
}

}  // namespace

void CleanOptions::check() const {
  check_not_negative("spike_sigma", spike_sigma);
  check_not_negative("spike_height", spike_height);
  check_range("spike_neighbours", spike_neighbours, 3, 64);
  check_not_negative("outlier_sigma", outlier_sigma);
  check_range("outlier_neighbours", outlier_neighbours, 1, 64);
  check_not_negative("voxel", voxel);
  resolve_threads(num_threads);
}

CleanResult clean_cloud(const PointCloud& cloud, const CleanOptions& options) {
  options.check();
  if (cloud.size() > std::numeric_limits<std::int32_t>::max()) {
    throw_argument("cloud", "at most 2147483647 points", std::to_string(cloud.size()));
  }
  CleanReport report;
  report.before = cloud.size();
  Soundings soundings = finite_soundings(cloud.points());
  report.not_finite = report.before - static_cast<Index>(soundings.size());
  put_in_canonical_order(soundings, options.num_threads);
  report.duplicates = drop(soundings, mark_duplicates(soundings));
  report.same_place_dropped =
      drop(soundings, mark_same_place(soundings, options.same_place, report.same_place));
  if (options.spike_sigma > 0.0) report.spikes = drop(soundings, mark_spikes(soundings, options));
  if (options.outlier_sigma > 0.0) {
    report.outliers = drop(soundings, mark_outliers(soundings, options));
  }
  if (options.voxel > 0.0) report.thinned = drop(soundings, mark_thinned(soundings, options));
  report.after = static_cast<Index>(soundings.size());

  Indices rows = rows_in_order(soundings, options.num_threads);
  PointCloud kept = take_rows(cloud, rows, options.num_threads);
  return {std::move(kept), report, std::move(rows)};
}

std::string CleanReport::text() const {
  std::string text = std::to_string(after) + " of " + std::to_string(before) + " soundings kept";
  const std::pair<Index, const char*> steps[] = {
      {not_finite, "dropped: a coordinate is not finite"},
      {duplicates, "dropped: exact duplicates (equal x, y, z)"},
      {same_place - same_place_dropped, "kept: share x, y with another z"},
      {same_place_dropped, "dropped: share x, y with the one that was kept"},
      {spikes, "dropped: spikes above or below their neighbours"},
      {outliers, "dropped: outliers, far from their neighbours"},
      {thinned, "dropped: thinned by voxels"}};
  for (const auto& [count, what] : steps) {
    if (count > 0) text.append("\n  ").append(std::to_string(count)).append(" ").append(what);
  }
  return text;
}

}  // namespace bathyal
