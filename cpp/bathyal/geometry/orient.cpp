// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/orient.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "bathyal/geometry/point_cloud.hpp"

namespace bathyal {
namespace {

constexpr double kClosed = 0.1;  // sum of area vectors over sum of areas; 0 for a closed surface

struct DirectedEdge {
  std::int32_t low, high;
  std::int32_t triangle;
  bool upward;
};

struct Neighbour {
  std::int32_t triangle = -1;
  bool same_way = false;  ///< both run the same way along the edge: one of them must be turned
};

/// Up to three neighbours of each triangle, across edges that exactly two triangles share.
std::vector<std::array<Neighbour, 3>> find_neighbours(const TriangleMatrix& triangles) {
  std::vector<DirectedEdge> sides;
  sides.reserve(static_cast<std::size_t>(triangles.size()));
  for (Index t = 0; t < triangles.rows(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const std::int32_t a = triangles(t, c);
      const std::int32_t b = triangles(t, (c + 1) % 3);
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), a < b});
    }
  }
  const auto key = [](const DirectedEdge& s) { return std::array{s.low, s.high, s.triangle}; };
  std::sort(sides.begin(), sides.end(),
            [&](const DirectedEdge& a, const DirectedEdge& b) { return key(a) < key(b); });

  std::vector<std::array<Neighbour, 3>> result(static_cast<std::size_t>(triangles.rows()));
  const auto add = [&](const DirectedEdge& to, const DirectedEdge& other) {
    for (Neighbour& slot : result[static_cast<std::size_t>(to.triangle)]) {
      if (slot.triangle >= 0) continue;
      slot = {other.triangle, to.upward == other.upward};
      return;
    }
  };
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low &&
           sides[end].high == sides[i].high) {
      ++end;
    }
    if (end - i == 2) {
      add(sides[i], sides[i + 1]);
      add(sides[i + 1], sides[i]);
    }
    i = end;
  }
  return result;
}

}  // namespace

void orient(PointView points, TriangleMatrix& triangles) {
  const auto neighbours = find_neighbours(triangles);
  const Vec3 origin = local_origin(points);
  const auto corner = [&](Index t, int c) -> Vec3 {
    return points.row(triangles(t, c)).transpose() - origin;
  };
  const auto turn = [&](Index t) { std::swap(triangles(t, 1), triangles(t, 2)); };

  enum class State : std::uint8_t { kUnseen, kKept, kTurned };
  std::vector<State> state(neighbours.size(), State::kUnseen);
  std::vector<std::int32_t> piece;
  for (std::size_t start = 0; start < neighbours.size(); ++start) {
    if (state[start] != State::kUnseen) continue;
    state[start] = State::kKept;
    piece.assign(1, static_cast<std::int32_t>(start));
    Vec3 balance = Vec3::Zero(), centre = Vec3::Zero();
    double volume = 0.0, area = 0.0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const auto t = static_cast<std::size_t>(piece[i]);
      const bool turned = state[t] == State::kTurned;
      if (turned) turn(piece[i]);
      for (const Neighbour& n : neighbours[t]) {
        if (n.triangle < 0 || state[static_cast<std::size_t>(n.triangle)] != State::kUnseen)
          continue;
        state[static_cast<std::size_t>(n.triangle)] =
            turned != n.same_way ? State::kTurned : State::kKept;
        piece.push_back(n.triangle);
      }
      const Vec3 a = corner(piece[i], 0);
      const Vec3 twice_area = (corner(piece[i], 1) - a).cross(corner(piece[i], 2) - a);
      volume += a.dot(twice_area);
      area += twice_area.norm();
      balance += twice_area;
      centre += a;
    }
    centre /= static_cast<double>(piece.size());
    const bool closed = balance.norm() < kClosed * area;
    if ((closed ? volume - centre.dot(balance) : balance.z()) < 0.0) {
      for (const std::int32_t t : piece) turn(t);
    }
  }
}

}  // namespace bathyal
