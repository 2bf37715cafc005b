// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/internal/welded_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace bathyal::workspace {
namespace {

struct PositionHash {
  std::size_t operator()(const Vec3& p) const {
    std::uint64_t hash = 0;
    for (const double value : p) {
      // Adding 0 makes one of the two zeros, which are equal.
      hash = (hash ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 29U;
    }
    return hash;
  }
};

/// An edge of a triangle, from the lower to the higher vertex; `turn` +1 where the triangle runs
/// that way, else −1.
struct HalfEdge {
  std::int32_t low, high, triangle, turn;
};

std::vector<HalfEdge> sorted_edges(const WeldedMesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int32_t a = mesh.triangles[t][c], b = mesh.triangles[t][(c + 1) % 3];
      if (a == b) continue;
      edges.push_back(
          {std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), a < b ? 1 : -1});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return edges;
}

/// Sets of triangles that were joined, each named by its lowest.
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  std::int32_t find(std::int32_t i) {
    while (at(i) != i) i = at(i) = at(at(i));
    return i;
  }

  void join(std::int32_t a, std::int32_t b) {
    a = find(a), b = find(b);
    at(std::max(a, b)) = std::min(a, b);
  }

 private:
  std::int32_t& at(std::int32_t i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<std::int32_t> parent_;
};

void number_parts(Joined& joined, EdgeReport& report) {
  for (std::size_t t = 0; t < report.part.size(); ++t) {
    const auto first = static_cast<std::size_t>(joined.find(static_cast<std::int32_t>(t)));
    report.part[t] = first == t ? report.parts++ : report.part[first];
  }
}

}  // namespace

WeldedMesh::WeldedMesh(const TriangleMesh& mesh) {
  const PointView vertices = mesh.vertices();
  const TriangleView rows = mesh.triangles();
  std::vector<std::int32_t> welded(static_cast<std::size_t>(vertices.rows()), -1);
  std::unordered_map<Vec3, std::int32_t, PositionHash> known;
  known.reserve(welded.size());
  triangles.resize(static_cast<std::size_t>(rows.rows()));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int32_t vertex = rows(static_cast<Index>(t), static_cast<Index>(c));
      std::int32_t& number = welded[static_cast<std::size_t>(vertex)];
      if (number < 0) {
        const Vec3 position = vertices.row(vertex);
        const auto [found, is_new] =
            known.emplace(position, static_cast<std::int32_t>(points.size()));
        if (is_new) points.push_back(position);
        number = found->second;
      }
      triangles[t][c] = number;
    }
  }
}

Eigen::AlignedBox3d WeldedMesh::box() const {
  Eigen::AlignedBox3d box;
  for (const Vec3& point : points) box.extend(point);
  return box;
}

EdgeReport edge_report(const WeldedMesh& mesh) {
  EdgeReport report;
  const std::vector<HalfEdge> edges = sorted_edges(mesh);
  Joined joined(mesh.triangles.size());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    const HalfEdge& first = edges[begin];
    int turns = 0;
    for (end = begin;
         end < edges.size() && edges[end].low == first.low && edges[end].high == first.high;
         ++end) {
      turns += edges[end].turn;
      joined.join(first.triangle, edges[end].triangle);
    }
    const std::size_t count = end - begin;
    report.boundary += count == 1;
    report.nonmanifold += count > 2;
    report.inconsistent += count == 2 && turns != 0;
    if (turns > 0) report.open.push_back({first.low, first.high, turns});
    if (turns < 0) report.open.push_back({first.high, first.low, -turns});
  }
  report.part.resize(mesh.triangles.size());
  number_parts(joined, report);
  return report;
}

}  // namespace bathyal::workspace
