// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/processing/mosaic.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr double kMostCells = 4e8;

bool known(const RowPlace& place) {
  return std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.heading);
}

/// Sums of a row's power from its start, read at any place between samples.
class RunningPower {
 public:
  explicit RunningPower(std::span<const float> row) {
    for (const float power : row) {
      if (!std::isfinite(power)) break;
      sums_.push_back(sums_.back() + power);
    }
  }

  double length() const { return static_cast<double>(sums_.size() - 1); }

  double until(double sample) const {
    const auto whole = static_cast<std::size_t>(sample);
    if (whole + 1 >= sums_.size()) return sums_.back();
    const double rest = sample - static_cast<double>(whole);
    return sums_[whole] + rest * (sums_[whole + 1] - sums_[whole]);
  }

 private:
  std::vector<double> sums_{0.0};
};

/// Where the bins of one ping's row lie.
struct Strip {
  Vec2 start, step;

  Vec2 middle(std::int64_t bin) const { return start + (static_cast<double>(bin) + 0.5) * step; }
};

Strip strip_of(const RowPlace& place, Side side, double spacing) {
  const Vec2 starboard(std::cos(place.heading), -std::sin(place.heading));
  return {Vec2(place.x, place.y), (side == Side::kStarboard ? spacing : -spacing) * starboard};
}

class Canvas {
 public:
  Canvas(const Eigen::AlignedBox2d& box, double spacing) : spacing_(spacing) {
    west_ = std::floor(box.min().x() / spacing) * spacing;
    north_ = std::ceil(box.max().y() / spacing) * spacing;
    const double columns = std::floor((box.max().x() - west_) / spacing) + 1.0;
    const double rows = std::floor((north_ - box.min().y()) / spacing) + 1.0;
    if (!(rows * columns <= kMostCells)) {
      throw_argument("spacing", "one that gives at most " + to_text(kMostCells) + " cells",
                     to_text(spacing) + ", which gives " + to_text(std::round(rows * columns)));
    }
    rows_ = static_cast<std::int64_t>(rows);
    columns_ = static_cast<std::int64_t>(columns);
    sums_.assign(static_cast<std::size_t>(rows_ * columns_), 0.0F);
    weights_ = filled_ = filled_weights_ = sums_;
  }

  /// In cells from the corner: x east, y south.
  Vec2 in_cells(const Vec2& point) const {
    return {(point.x() - west_) / spacing_, (north_ - point.y()) / spacing_};
  }

  void add(const Vec2& point, float power) {
    const Vec2 at = in_cells(point);
    const std::size_t cell = index(static_cast<std::int64_t>(std::floor(at.y())),
                                   static_cast<std::int64_t>(std::floor(at.x())));
    sums_[cell] += power;
    weights_[cell] += 1.0F;
  }

  /// Interpolates in the cells whose middles lie in a triangle.
  void fill(const std::array<Vec2, 3>& corners, const std::array<float, 3>& power) {
    const Vec2 a = in_cells(corners[0]), b = in_cells(corners[1]), c = in_cells(corners[2]);
    const Vec2 u = b - a, v = c - a;
    const double area = u.x() * v.y() - u.y() * v.x();
    if (area == 0.0) return;
    const Vec2 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    const auto first = [](double value) {
      return static_cast<std::int64_t>(std::ceil(value - 0.5));
    };
    for (std::int64_t row = first(low.y()); static_cast<double>(row) + 0.5 <= high.y(); ++row) {
      for (std::int64_t column = first(low.x()); static_cast<double>(column) + 0.5 <= high.x();
           ++column) {
        const Vec2 w(static_cast<double>(column) + 0.5 - a.x(),
                     static_cast<double>(row) + 0.5 - a.y());
        const double s = (w.x() * v.y() - w.y() * v.x()) / area;
        const double t = (u.x() * w.y() - u.y() * w.x()) / area;
        if (s < 0.0 || t < 0.0 || s + t > 1.0) continue;
        const std::size_t cell = index(row, column);
        filled_[cell] += static_cast<float>((1.0 - s - t) * power[0] + s * power[1] + t * power[2]);
        filled_weights_[cell] += 1.0F;
      }
    }
  }

  Mosaic mosaic() const {
    Mosaic made;
    made.rows = rows_;
    made.columns = columns_;
    made.west = west_;
    made.north = north_;
    made.spacing = spacing_;
    made.power.assign(sums_.size(), kUnknown);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      if (weights_[i] > 0.0F) {
        made.power[i] = sums_[i] / weights_[i];
      } else if (filled_weights_[i] > 0.0F) {
        made.power[i] = filled_[i] / filled_weights_[i];
      }
    }
    return made;
  }

 private:
  std::size_t index(std::int64_t row, std::int64_t column) const {
    row = std::clamp<std::int64_t>(row, 0, rows_ - 1);
    column = std::clamp<std::int64_t>(column, 0, columns_ - 1);
    return static_cast<std::size_t>(row * columns_ + column);
  }

  double spacing_, west_ = 0.0, north_ = 0.0;
  std::int64_t rows_ = 0, columns_ = 0;
  std::vector<float> sums_, weights_, filled_, filled_weights_;
};

/// Between the rows of two neighbouring pings, from the track itself on.
void fill_between(Canvas& canvas, const Strip& one, std::span<const float> power_one,
                  const Strip& other, std::span<const float> power_other) {
  std::array<Vec2, 2> near{one.start, other.start};
  for (std::size_t k = 0; k < power_one.size(); ++k) {
    const auto bin = static_cast<std::int64_t>(k);
    const std::array<Vec2, 2> far{one.middle(bin), other.middle(bin)};
    const std::size_t before = k == 0 ? 0 : k - 1;
    const std::array<float, 4> power{power_one[before], power_one[k], power_other[k],
                                     power_other[before]};
    if (std::all_of(power.begin(), power.end(), [](float p) { return std::isfinite(p); })) {
      canvas.fill({near[0], far[0], far[1]}, {power[0], power[1], power[2]});
      canvas.fill({near[0], far[1], near[1]}, {power[0], power[2], power[3]});
    }
    near = far;
  }
}

Eigen::AlignedBox2d box_of(const SidescanRows& ground, std::span<const Side> sides,
                           std::span<const RowPlace> places) {
  Eigen::AlignedBox2d box;
  for (const RowPlace& place : places) {
    if (!known(place)) continue;
    for (const Side side : sides) {
      const Strip strip = strip_of(place, side, ground.sample_length);
      box.extend(strip.start);
      box.extend(strip.middle(ground.samples));
    }
  }
  return box;
}

}  // namespace

void SidescanRows::check() const {
  if (pings < 0 || beams < 0 || samples < 0 ||
      static_cast<std::int64_t>(power.size()) != pings * beams * samples) {
    throw_argument("power", "pings of that many beams and samples", "other sizes");
  }
  check_positive("sample_length", sample_length);
}

void MosaicOptions::check() const {
  check_positive("spacing", spacing);
  check_not_negative("gap", gap);
}

GroundRows to_ground(const SidescanRows& slant, std::span<const double> first, double spacing) {
  slant.check();
  check_positive("spacing", spacing);
  if (static_cast<std::int64_t>(first.size()) != slant.pings * slant.beams) {
    throw_argument("first", "a range for each row", std::to_string(first.size()));
  }
  const double reach = static_cast<double>(slant.samples) * slant.sample_length;
  double farthest = 0.0;
  for (const double h : first) {
    if (h >= 0.0 && h < reach) farthest = std::max(farthest, std::sqrt(reach * reach - h * h));
  }
  GroundRows ground{{}, slant.pings, slant.beams, 0, spacing};
  const double bins = std::floor(farthest / spacing);
  if (!(bins * static_cast<double>(first.size()) <= kMostCells)) {
    throw_argument("spacing", "one that gives at most " + to_text(kMostCells) + " bins",
                   to_text(spacing));
  }
  ground.bins = static_cast<std::int64_t>(bins);
  ground.power.assign(first.size() * static_cast<std::size_t>(ground.bins), kUnknown);
  for (std::size_t row = 0; row < first.size(); ++row) {
    const double h = first[row];
    if (!(h >= 0.0)) continue;
    const auto number = static_cast<std::int64_t>(row);
    const RunningPower sums(slant.row(number / slant.beams, number % slant.beams));
    float* out = ground.power.data() + row * static_cast<std::size_t>(ground.bins);
    double near = h / slant.sample_length;
    for (std::int64_t k = 0; k < ground.bins; ++k) {
      const double far = std::hypot(h, spacing * static_cast<double>(k + 1)) / slant.sample_length;
      if (far > sums.length()) break;
      if (far > near) {
        out[k] = static_cast<float>((sums.until(far) - sums.until(near)) / (far - near));
      }
      near = far;
    }
  }
  return ground;
}

Mosaic mosaic_of(const SidescanRows& ground, std::span<const Side> sides,
                 std::span<const RowPlace> places, const MosaicOptions& options) {
  ground.check();
  options.check();
  if (static_cast<std::int64_t>(sides.size()) != ground.beams ||
      static_cast<std::int64_t>(places.size()) != ground.pings) {
    throw_argument("places", "one for each ping, and a side for each beam", "other sizes");
  }
  const Eigen::AlignedBox2d box = box_of(ground, sides, places);
  if (box.isEmpty()) throw Error("no ping has a position and a heading: there is no mosaic");
  Canvas canvas(box, options.spacing);
  std::int64_t left_out = 0;
  std::int64_t before = -1;  // the last ping that has a place
  for (std::int64_t p = 0; p < ground.pings; ++p) {
    const RowPlace& place = places[static_cast<std::size_t>(p)];
    if (!known(place)) {
      ++left_out;
      continue;
    }
    const RowPlace& last = places[static_cast<std::size_t>(std::max<std::int64_t>(before, 0))];
    const bool near = before >= 0 && std::hypot(place.x - last.x, place.y - last.y) <= options.gap;
    for (std::int64_t b = 0; b < ground.beams; ++b) {
      const Side side = sides[static_cast<std::size_t>(b)];
      const Strip strip = strip_of(place, side, ground.sample_length);
      const std::span<const float> row = ground.row(p, b);
      for (std::size_t k = 0; k < row.size(); ++k) {
        if (std::isfinite(row[k])) canvas.add(strip.middle(static_cast<std::int64_t>(k)), row[k]);
      }
      if (near) {
        fill_between(canvas, strip_of(last, side, ground.sample_length), ground.row(before, b),
                     strip, row);
      }
    }
    before = p;
  }
  Mosaic made = canvas.mosaic();
  made.left_out = left_out;
  return made;
}

}  // namespace bathyal
