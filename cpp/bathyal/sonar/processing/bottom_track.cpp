// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/processing/bottom_track.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

constexpr std::int64_t kBefore = 24, kAfter = 8;  // samples compared with each other
constexpr std::int64_t kMostStep = 8;             // samples from ping to ping
constexpr float kStepCost = 1.0F;                 // of each, in units of log likelihood
constexpr float kLeastGain = 4.0F;                // of log likelihood, to be called a bottom
constexpr std::int64_t kBlock = 2048, kAhead = 64;

constexpr std::int64_t kBackground = 60, kLeastBackground = 20, kGuard = 4, kHold = 8;
constexpr std::int64_t kHalfMedian = 2;

struct Rows {
  std::span<const float> power;
  std::int64_t pings = 0, samples = 0, stride = 0;

  std::span<const float> row(std::int64_t ping) const {
    return power.subspan(static_cast<std::size_t>(ping * stride),
                         static_cast<std::size_t>(samples));
  }
};

std::int64_t length_of(std::span<const float> row) {
  const auto end = std::find_if(row.begin(), row.end(), [](float p) { return !std::isfinite(p); });
  return end - row.begin();
}

/// Sums of the row from its start, with a floor far below its mean: no power at all is as quiet as
/// the logarithm can bear.
std::vector<double> running_sums(std::span<const float> row, std::int64_t length) {
  double mean = 0.0;
  for (std::int64_t i = 0; i < length; ++i) mean += row[static_cast<std::size_t>(i)];
  mean /= static_cast<double>(std::max<std::int64_t>(length, 1));
  std::vector<double> sums{0.0};
  for (std::int64_t i = 0; i < length; ++i) {
    sums.push_back(sums.back() + row[static_cast<std::size_t>(i)] + 1e-6 * mean);
  }
  return sums;
}

/// Gain in log likelihood when the power changes at each sample; 0 where it does not rise.
std::vector<float> change_gains(std::span<const float> row, std::int64_t first) {
  std::vector<float> gains(row.size(), 0.0F);
  const std::int64_t length = length_of(row);
  const std::vector<double> sums = running_sums(row, length);
  if (sums.back() <= 0.0) return gains;
  for (std::int64_t i = first + kBefore; i + kAfter <= length; ++i) {
    const auto at = [&](std::int64_t k) { return sums[static_cast<std::size_t>(k)]; };
    const double before = (at(i) - at(i - kBefore)) / kBefore;
    const double after = (at(i + kAfter) - at(i)) / kAfter;
    if (after <= before) continue;
    const double both = (at(i + kAfter) - at(i - kBefore)) / (kBefore + kAfter);
    gains[static_cast<std::size_t>(i)] =
        static_cast<float>((kBefore + kAfter) * std::log(both) - kBefore * std::log(before) -
                           kAfter * std::log(after));
  }
  return gains;
}

/// The best path through the pings from `begin` to `end`, from the sample `start` where there is
/// one.
std::vector<std::int64_t> best_path(const Rows& rows, std::int64_t begin, std::int64_t end,
                                    std::int64_t first, std::int64_t start) {
  const std::int64_t samples = rows.samples;
  const auto width = static_cast<std::size_t>(samples);
  std::vector<float> score(width, 0.0F), next(width);
  if (start != kNoBottom) {
    for (std::int64_t i = 0; i < samples; ++i) {
      score[static_cast<std::size_t>(i)] = -kStepCost * static_cast<float>(std::abs(i - start));
    }
  }
  std::vector<std::int8_t> steps(width * static_cast<std::size_t>(end - begin), 0);
  std::vector<std::vector<float>> gains;
  for (std::int64_t p = begin; p < end; ++p) {
    gains.push_back(change_gains(rows.row(p), first));
    std::int8_t* step_of = steps.data() + width * static_cast<std::size_t>(p - begin);
    for (std::int64_t i = 0; i < samples; ++i) {
      float best = -std::numeric_limits<float>::infinity();
      const std::int64_t low = std::max<std::int64_t>(0, i - kMostStep);
      const std::int64_t high = std::min(samples - 1, i + kMostStep);
      for (std::int64_t k = low; k <= high; ++k) {
        const float reached =
            score[static_cast<std::size_t>(k)] - kStepCost * static_cast<float>(std::abs(i - k));
        if (reached > best) {
          best = reached;
          step_of[i] = static_cast<std::int8_t>(i - k);
        }
      }
      next[static_cast<std::size_t>(i)] = best + gains.back()[static_cast<std::size_t>(i)];
    }
    score.swap(next);
  }
  std::int64_t at = std::max_element(score.begin(), score.end()) - score.begin();
  std::vector<std::int64_t> path(static_cast<std::size_t>(end - begin));
  for (std::int64_t p = end - begin - 1; p >= 0; --p) {
    const auto ping = static_cast<std::size_t>(p);
    path[ping] = gains[ping][static_cast<std::size_t>(at)] >= kLeastGain ? at : kNoBottom;
    at -= steps[width * ping + static_cast<std::size_t>(at)];
  }
  return path;
}

/// Block by block, each seen a little ahead, so that memory does not grow with the pings.
std::vector<std::int64_t> by_likelihood(const Rows& rows, std::int64_t first) {
  std::vector<std::int64_t> found;
  std::int64_t last = kNoBottom;
  for (std::int64_t begin = 0; begin < rows.pings; begin += kBlock) {
    const std::int64_t end = std::min(rows.pings, begin + kBlock + kAhead);
    const std::vector<std::int64_t> path = best_path(rows, begin, end, first, last);
    const std::int64_t kept = std::min(kBlock, rows.pings - begin);
    found.insert(found.end(), path.begin(), path.begin() + kept);
    if (found.back() != kNoBottom) last = found.back();
  }
  return found;
}

/// Logarithm of the power, averaged over three samples of one ping.
std::vector<double> smooth_logarithm(std::span<const float> row) {
  const std::int64_t length = length_of(row);
  const std::vector<double> sums = running_sums(row, length);
  std::vector<double> logs(row.size(), std::numeric_limits<double>::quiet_NaN());
  if (sums.back() <= 0.0) return logs;
  std::vector<double> single;
  for (std::int64_t i = 0; i < length; ++i) {
    const auto k = static_cast<std::size_t>(i);
    single.push_back(std::log(sums[k + 1] - sums[k]));
  }
  for (std::int64_t i = 1; i + 1 < length; ++i) {
    const auto k = static_cast<std::size_t>(i);
    logs[k] = (single[k - 1] + single[k] + single[k + 1]) / 3.0;
  }
  return logs;
}

/// First sample from which on kHold samples are `rise` above the mean of those before.
std::int64_t first_rise(const std::vector<double>& logs, std::int64_t first, double rise) {
  std::vector<double> sums{0.0};
  for (const double value : logs) sums.push_back(sums.back() + (std::isnan(value) ? 0.0 : value));
  const auto samples = static_cast<std::int64_t>(logs.size());
  for (std::int64_t i = first + kLeastBackground + kGuard; i + kHold < samples; ++i) {
    const std::int64_t low = std::max(first, i - kGuard - kBackground), high = i - kGuard;
    const double level =
        (sums[static_cast<std::size_t>(high)] - sums[static_cast<std::size_t>(low)]) /
        static_cast<double>(high - low);
    const auto at = logs.begin() + i;
    if (std::all_of(at, at + kHold, [&](double value) { return value > level + rise; })) return i;
  }
  return kNoBottom;
}

std::vector<std::int64_t> medians(const std::vector<std::int64_t>& values) {
  std::vector<std::int64_t> all;
  const auto count = static_cast<std::int64_t>(values.size());
  for (std::int64_t p = 0; p < count; ++p) {
    std::vector<std::int64_t> near;
    for (std::int64_t k = std::max<std::int64_t>(0, p - kHalfMedian);
         k <= std::min(count - 1, p + kHalfMedian); ++k) {
      const std::int64_t value = values[static_cast<std::size_t>(k)];
      if (value != kNoBottom) near.push_back(value);
    }
    const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
    std::nth_element(near.begin(), middle, near.end());
    all.push_back(near.empty() || values[static_cast<std::size_t>(p)] == kNoBottom ? kNoBottom
                                                                                   : *middle);
  }
  return all;
}

std::vector<std::int64_t> by_threshold(const Rows& rows, const BottomTrackOptions& options) {
  const double rise = options.threshold_db * std::log(10.0) / 10.0;
  std::vector<std::vector<double>> near;  // the ping before, this one, the next
  std::vector<std::int64_t> found;
  for (std::int64_t p = 0; p < rows.pings; ++p) {
    if (p == 0) near.push_back(smooth_logarithm(rows.row(0)));
    if (p + 1 < rows.pings) near.push_back(smooth_logarithm(rows.row(p + 1)));
    if (near.size() > 3 || (p + 1 == rows.pings && near.size() > 2)) near.erase(near.begin());
    std::vector<double> mean(static_cast<std::size_t>(rows.samples), 0.0);
    for (const auto& logs : near) {
      for (std::size_t i = 0; i < mean.size(); ++i) {
        mean[i] += logs[i] / static_cast<double>(near.size());
      }
    }
    // the smoothed rows begin with their second sample
    found.push_back(first_rise(mean, std::max<std::int64_t>(1, options.first_sample), rise));
  }
  return medians(found);
}

}  // namespace

void BottomTrackOptions::check() const {
  if (first_sample < 0) {
    throw_argument("first_sample", "a whole number of 0 or more", std::to_string(first_sample));
  }
  check_positive("threshold_db", threshold_db);
}

std::vector<std::int64_t> track_bottom(std::span<const float> power, std::int64_t pings,
                                       std::int64_t samples, std::int64_t stride,
                                       const BottomTrackOptions& options) {
  options.check();
  const bool fits =
      pings >= 0 && samples >= 0 && stride >= samples &&
      (pings == 0 || static_cast<std::int64_t>(power.size()) >= (pings - 1) * stride + samples);
  if (!fits) throw_argument("power", "pings of that many samples", "other sizes");
  if (samples == 0) return std::vector<std::int64_t>(static_cast<std::size_t>(pings), kNoBottom);
  const Rows rows{power, pings, samples, stride};
  return options.picker == BottomPicker::kLikelihood ? by_likelihood(rows, options.first_sample)
                                                     : by_threshold(rows, options);
}

}  // namespace bathyal
