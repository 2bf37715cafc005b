// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "bathyal/base/check.hpp"
#include "bathyal/base/random.hpp"
#include "bathyal/world/generate/internal/plate.hpp"
#include "bathyal/world/generate/solids.hpp"

namespace bathyal {
namespace {

using generate::MeshBuilder;
using generate::SquareMask;

/// The lines of the ship: sections over its length, from 0 at the stern to 1 at the bow.
struct ShipLines {
  double length, beam, depth, thickness;

  double x(double u) const { return (u - 0.5) * length; }

  /// Half the breadth at the deck, never narrower than its plates.
  double half_breadth(double u) const {
    const double stern = 1.0 - 0.35 * std::pow(std::max(0.0, 1.0 - u / 0.25), 2.0);
    const double bow = 1.0 - std::pow(std::max(0.0, (u - 0.68) / 0.32), 2.2);
    return std::max(0.5 * beam * stern * bow, 2.0 * thickness);
  }

  double deck(double u) const {
    return depth * (1.0 + 0.25 * std::pow(std::max(0.0, (u - 0.6) / 0.4), 2.0));
  }

  /// A superellipse, full amidships, fine towards the bow; v from −1 at the port gunwale over 0 at
  /// the keel to 1 at the starboard one; `inset` from the outside.
  Vec3 shell(double u, double v, double inset) const {
    const double fullness = 4.0 - 2.2 * std::max(0.0, (u - 0.6) / 0.4);
    const double angle = 0.5 * std::numbers::pi * v;
    const double across = std::pow(std::abs(std::sin(angle)), 2.0 / fullness);
    const double down = std::pow(std::max(0.0, std::cos(angle)), 2.0 / fullness);
    const double side = (half_breadth(u) - inset) * across;
    return {x(u), v < 0.0 ? side : -side, deck(u) - (deck(u) - inset) * down};
  }
};

/// Where it broke: the column of the grid up to which each of its rows belongs to the stern.
std::vector<int> tear(RandomStream& random, int columns, int rows, bool broken) {
  std::vector<int> edge(static_cast<std::size_t>(rows), columns);
  if (!broken) return edge;
  const double middle = columns * random.uniform(0.45, 0.6);
  double off = 0.0;
  for (int& column : edge) {
    off = 0.75 * off + random.uniform(-2.0, 2.0);
    column = std::clamp(static_cast<int>(middle + off), 1, columns - 1);
  }
  return edge;
}

SquareMask half_of(const SquareMask& whole, const std::vector<int>& edge, bool bow) {
  SquareMask half = whole;
  for (int j = 0; j < whole.rows; ++j) {
    for (int i = 0; i < whole.columns; ++i) {
      if ((i >= edge[static_cast<std::size_t>(j)]) != bow) half.set(i, j, false);
    }
  }
  half.join_corners();
  return half;
}

SquareMask shell_mask(RandomStream& random, int columns, int rows, int holes) {
  SquareMask mask(columns, rows);
  for (int h = 0; h < holes; ++h) {
    const double ci = random.uniform(0.05, 0.95) * columns;
    const double cj = random.uniform(0.1, 0.9) * rows;
    const double ri = random.uniform(1.0, 5.0);
    const double rj = random.uniform(1.0, 0.12 * rows);
    for (int j = 1; j + 1 < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        const double edge = std::hypot((i + 0.5 - ci) / ri, (j + 0.5 - cj) / rj);
        if (edge < 1.0 && random.uniform() > 0.4 * edge) mask.set(i, j, false);
      }
    }
  }
  return mask;
}

/// Four hatches along the middle.
SquareMask deck_mask(int columns, int rows) {
  SquareMask mask(columns, rows);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const double u = (i + 0.5) / columns;
      const bool along = u > 0.34 && u < 0.88 && std::fmod(u - 0.34, 0.135) < 0.085;
      if (along && std::abs((j + 0.5) / rows - 0.5) < 0.25) mask.set(i, j, false);
    }
  }
  return mask;
}

void add_shell(MeshBuilder& builder, const ShipLines& lines, const SquareMask& mask) {
  std::vector<Vec3> outer, inner;
  for (int j = 0; j <= mask.rows; ++j) {
    for (int i = 0; i <= mask.columns; ++i) {
      const double u = static_cast<double>(i) / mask.columns;
      const double v = 2.0 * j / mask.rows - 1.0;
      outer.push_back(lines.shell(u, v, 0.0));
      inner.push_back(lines.shell(u, v, lines.thickness));
    }
  }
  add_plate(builder, mask, outer, inner);
}

void add_deck(MeshBuilder& builder, const ShipLines& lines, const SquareMask& mask) {
  std::vector<Vec3> top, bottom;
  for (int j = 0; j <= mask.rows; ++j) {
    for (int i = 0; i <= mask.columns; ++i) {
      const double u = static_cast<double>(i) / mask.columns;
      const double side = lines.half_breadth(u) - 0.5 * lines.thickness;
      const double z = lines.deck(u) - 0.1 * lines.depth;
      const double y = side * (2.0 * j / mask.rows - 1.0);
      top.emplace_back(lines.x(u), y, z);
      bottom.emplace_back(lines.x(u), y, z - lines.thickness);
    }
  }
  add_plate(builder, mask, top, bottom);
}

/// A wall across, its rim in the middle of the hull's plates.
void add_bulkhead(MeshBuilder& builder, const ShipLines& lines, double u) {
  const int count = 32;
  const auto ring = [&](double off) {
    generate::Ring points;
    for (int j = 0; j <= count; ++j) {
      Vec3 point = lines.shell(u, 1.0 - 2.0 * j / count, 0.5 * lines.thickness);
      point.x() += off;
      point.z() = std::min(point.z(), lines.deck(u) - 0.1 * lines.depth);
      points.push_back(point);
    }
    return points;
  };
  builder.loft({ring(-0.5 * lines.thickness), ring(0.5 * lines.thickness)});
}

void add_house(MeshBuilder& builder, const ShipLines& lines, RandomStream& random) {
  const double deck = lines.deck(0.2) - 0.1 * lines.depth - 0.5 * lines.thickness;
  const double half = 0.36 * lines.beam;
  double low = deck;
  for (const double part : {1.0, 0.75, 0.5}) {
    const double high = low + 0.42 * lines.depth;
    builder.box({lines.x(0.1), -half * part, low}, {lines.x(0.1 + 0.17 * part), half * part, high});
    low = high - 0.5 * lines.thickness;
  }
  const Vec3 foot(lines.x(0.14), 0.0, low - 0.1);
  builder.cylinder(foot, foot + Vec3(-0.1, 0.0, 0.5) * lines.depth, 0.1 * lines.beam, 20);
  const double lean = random.uniform(-0.3, 0.3);
  const Vec3 step(lines.x(0.3), 0.0, deck);
  builder.cylinder(step, step + Vec3(0.2 * lean, lean, 1.0) * 1.6 * lines.depth, 0.02 * lines.beam,
                   10);
}

Pose leaning(double list, double yaw, const Vec3& at) {
  Pose pose = Pose::Identity();
  pose.translate(at);
  pose.rotate(Eigen::AngleAxisd(yaw, Vec3::UnitZ()));
  pose.rotate(Eigen::AngleAxisd(list, Vec3::UnitX()));
  return pose;
}

/// Moves the vertices from `first` on so that the lowest is at z = 0.
void settle_part(MeshBuilder& builder, std::size_t first) {
  double lowest = 1e300;
  for (std::size_t i = first; i < builder.vertices().size(); ++i) {
    lowest = std::min(lowest, builder.vertices()[i].z());
  }
  for (std::size_t i = first; i < builder.vertices().size(); ++i) {
    builder.vertices()[i].z() -= lowest;
  }
}

}  // namespace

void WreckOptions::check(double length) const {
  check_range("length", length, 1.0, 1000.0);
  check_range("beam", beam, 0.1, length);
  check_range("depth", depth, 0.1, length);
  check_positive("thickness", thickness);
  check_range("thickness", thickness, 0.0, 0.1 * std::min(beam, depth));
  check_range("list", list, -1.4, 1.4);
  check_range("holes", holes, 0, 1000);
  check_range("spacing", spacing, 1e-3 * length, 0.1 * length);
}

TriangleMesh make_wreck(double length, const WreckOptions& options) {
  options.check(length);
  const ShipLines lines{length, options.beam, options.depth, options.thickness};
  RandomStream random(options.seed, 0x3eec);
  const int columns = std::max(12, static_cast<int>(std::lround(length / options.spacing)));
  const double girth = options.beam + 2.0 * options.depth;
  const int rows = 2 * std::clamp(static_cast<int>(0.5 * girth / options.spacing), 8, 500);
  const int across = 2 * std::clamp(static_cast<int>(0.5 * options.beam / options.spacing), 4, 500);
  const SquareMask shell = shell_mask(random, columns, rows, options.holes);
  const SquareMask deck = deck_mask(columns, across);
  const std::vector<int> torn = tear(random, columns, rows, options.broken);
  const std::vector<int> torn_deck(static_cast<std::size_t>(across), torn.front());

  MeshBuilder builder;
  add_shell(builder, lines, half_of(shell, torn, false));
  add_deck(builder, lines, half_of(deck, torn_deck, false));
  for (const double u : {0.002, 0.3}) add_bulkhead(builder, lines, u);
  if (!options.broken) add_bulkhead(builder, lines, 0.7);
  add_house(builder, lines, random);
  builder.transform(leaning(options.list, 0.0, Vec3::Zero()));
  settle_part(builder, 0);
  if (!options.broken) return builder.mesh();

  const std::size_t first = builder.vertices().size();
  add_shell(builder, lines, half_of(shell, torn, true));
  add_deck(builder, lines, half_of(deck, torn_deck, true));
  for (const double u : {0.72, 0.995}) add_bulkhead(builder, lines, u);
  const double list = std::clamp(options.list + random.uniform(-0.4, 0.4), -1.4, 1.4);
  const double yaw = random.uniform(-0.5, 0.5);
  const Vec3 away(random.uniform(0.05, 0.12) * length, random.uniform(-0.3, 0.3) * options.beam,
                  0.0);
  builder.transform(leaning(list, yaw, away), first);
  settle_part(builder, first);
  return builder.mesh();
}

}  // namespace bathyal
