// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/internal/side_lobes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bathyal/base/parallel.hpp"
#include "bathyal/sonar/internal/beam_pattern.hpp"

namespace bathyal::sonar {
namespace {

constexpr int kAnglesOfSector = 16;
constexpr int kAnglesOfBeam = 400;

bool one_array(SonarKind kind) {
  return kind == SonarKind::kMultibeam || kind == SonarKind::kImaging;
}

/// Integral of a beam's receiving pattern over the angles that its own rays cover.
double own_integral(const SonarOptions& options, double steered) {
  const double reach = reach_of(options.beam_pattern, options.beam_width);
  const double step = 2.0 * reach / kAnglesOfBeam;
  double sum = 0.0;
  for (int k = 0; k < kAnglesOfBeam; ++k) {
    const double off = (k + 0.5) * step - reach;
    sum += step * pattern(options.beam_pattern, off, options.beam_width, steered);
  }
  return sum;
}

/// Integral of the pattern of the beam at `steered` over the sector about `middle`, where it has no
/// rays.
double far_integral(const SonarOptions& options, double steered, double middle, double sector) {
  const double reach = reach_of(options.beam_pattern, options.beam_width);
  const double step = sector / kAnglesOfSector;
  double sum = 0.0;
  for (int k = 0; k < kAnglesOfSector; ++k) {
    const double off = middle + (k + 0.5) * step - 0.5 * sector - steered;
    if (std::abs(off) <= reach) continue;
    sum += step * pattern(options.beam_pattern, off, options.beam_width, steered);
  }
  return sum;
}

/// First and past the last sample of a row that has any power.
std::pair<std::size_t, std::size_t> heard_samples(const double* row, std::size_t samples) {
  std::size_t first = 0, end = samples;
  while (first < end && row[first] == 0.0) ++first;
  while (end > first && row[end - 1] == 0.0) --end;
  return {first, end};
}

}  // namespace

SideLobes::SideLobes(const SonarOptions& options) {
  if (!options.side_lobes || !one_array(options.kind) || options.beams < 2 ||
      options.beam_pattern == BeamPattern::kNone) {
    return;
  }
  const std::vector<Beam> beams = beams_of(options);
  const double sector = options.sector / (options.beams - 1);
  beams_ = beams.size();
  mix_.resize(beams_ * beams_);
  std::vector<double> own;
  for (const Beam& beam : beams) own.push_back(own_integral(options, beam.steered));
  for (std::size_t i = 0; i < beams_; ++i) {
    for (std::size_t j = 0; j < beams_; ++j) {
      mix_[i * beams_ + j] =
          far_integral(options, beams[i].steered, beams[j].steered, sector) / own[j];
    }
  }
}

void SideLobes::add(Echo& echo, int num_threads) const {
  if (none()) return;
  const auto samples = static_cast<std::size_t>(echo.samples);
  const std::vector<double> heard = echo.power;
  std::vector<std::pair<std::size_t, std::size_t>> spans;
  for (std::size_t j = 0; j < beams_; ++j) {
    spans.push_back(heard_samples(heard.data() + j * samples, samples));
  }
  constexpr std::size_t kBeamsAtATime = 8;
  parallel_for(beams_, kBeamsAtATime, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double* to = echo.power.data() + i * samples;
      for (std::size_t j = 0; j < beams_; ++j) {
        const double part = mix_[i * beams_ + j];
        const double* from = heard.data() + j * samples;
        for (std::size_t k = spans[j].first; part > 0.0 && k < spans[j].second; ++k) {
          to[k] += part * from[k];
        }
      }
    }
  });
}

}  // namespace bathyal::sonar
