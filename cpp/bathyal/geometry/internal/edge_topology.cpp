// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/internal/edge_topology.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <tuple>

#include "bathyal/base/parallel.hpp"

namespace bathyal::geometry {
namespace {

constexpr std::size_t kGrain = 4096;

/// Things listed by the vertex they belong to: those of vertex v are items[start[v]] to
/// items[start[v + 1]], sorted.
template <class Item>
struct ByVertex {
  std::vector<std::size_t> start;
  std::vector<Item> items;
};

/// `each(emit)` calls emit(vertex, item) for every item, the same ones each time.
template <class Item, class Each>
ByVertex<Item> list_by_vertex(Index vertex_count, int num_threads, const Each& each) {
  ByVertex<Item> list;
  list.start.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  each([&](std::int32_t vertex, const Item&) {
    ++list.start[static_cast<std::size_t>(vertex) + 1];
  });
  std::partial_sum(list.start.begin(), list.start.end(), list.start.begin());
  list.items.resize(list.start.back());
  std::vector<std::size_t> next(list.start.begin(), list.start.end() - 1);
  each([&](std::int32_t vertex, const Item& item) {
    list.items[next[static_cast<std::size_t>(vertex)]++] = item;
  });
  parallel_for(next.size(), kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      std::sort(list.items.begin() + static_cast<std::ptrdiff_t>(list.start[v]),
                list.items.begin() + static_cast<std::ptrdiff_t>(list.start[v + 1]));
    }
  });
  return list;
}

/// One side of a triangle, listed under its lower vertex. `corner` is 3 × triangle + the corner it
/// starts from.
struct Side {
  std::int32_t other;
  std::uint32_t corner;
  bool upward;  ///< runs from the lower vertex to the higher

  auto operator<=>(const Side&) const = default;
};

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

std::uint32_t next_corner(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// The corners of a side at its lower and its higher vertex.
std::uint32_t low_corner(const Side& s) { return s.upward ? s.corner : next_corner(s.corner); }
std::uint32_t high_corner(const Side& s) { return s.upward ? next_corner(s.corner) : s.corner; }

ByVertex<Side> list_sides(TriangleView triangles, Index vertex_count, int num_threads) {
  return list_by_vertex<Side>(vertex_count, num_threads, [&](const auto& emit) {
    for (Index t = 0; t < triangles.rows(); ++t) {
      for (int c = 0; c < 3; ++c) {
        const std::int32_t a = triangles(t, c);
        const std::int32_t b = triangles(t, (c + 1) % 3);
        if (a == b) continue;
        emit(std::min(a, b), Side{std::max(a, b), static_cast<std::uint32_t>(3 * t + c), a < b});
      }
    }
  });
}

/// Corners of one vertex that are joined through triangles sharing an edge there: its fans.
Index count_vertices_of_several_fans(TriangleView triangles, DisjointSets& fans,
                                     Index vertex_count) {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> fan_of(static_cast<std::size_t>(vertex_count), kNone);
  std::vector<bool> several(static_cast<std::size_t>(vertex_count), false);
  for (Index i = 0; i < triangles.size(); ++i) {
    const auto vertex = static_cast<std::size_t>(triangles.data()[i]);
    const std::uint32_t fan = fans.root(static_cast<std::uint32_t>(i));
    if (fan_of[vertex] == kNone) fan_of[vertex] = fan;
    if (fan_of[vertex] != fan) several[vertex] = true;
  }
  return std::count(several.begin(), several.end(), true);
}

struct BoundaryEdge {
  std::uint32_t low_fan, high_fan;
  double length;
};

std::vector<double> loop_lengths(const std::vector<BoundaryEdge>& edges, std::size_t corner_count) {
  DisjointSets loops(corner_count);
  for (const BoundaryEdge& edge : edges) loops.join(edge.low_fan, edge.high_fan);
  std::vector<double> length(corner_count, 0.0);
  for (const BoundaryEdge& edge : edges) length[loops.root(edge.low_fan)] += edge.length;
  std::erase(length, 0.0);
  std::sort(length.begin(), length.end(), std::greater<>());
  return length;
}

}  // namespace

EdgeTopology edge_topology(const TriangleMesh& mesh, int num_threads) {
  const TriangleView triangles = mesh.triangles();
  const ByVertex<Side> sides = list_sides(triangles, mesh.vertex_count(), num_threads);
  const auto corner_count = static_cast<std::size_t>(triangles.size());
  DisjointSets fans(corner_count);
  DisjointSets pieces(corner_count / 3);
  EdgeTopology result;
  std::vector<const Side*> boundary;

  for (std::size_t v = 0; v + 1 < sides.start.size(); ++v) {
    for (std::size_t i = sides.start[v]; i < sides.start[v + 1];) {
      const Side& first = sides.items[i];
      std::size_t end = i + 1;
      while (end < sides.start[v + 1] && sides.items[end].other == first.other) {
        const Side& side = sides.items[end++];
        fans.join(low_corner(first), low_corner(side));
        fans.join(high_corner(first), high_corner(side));
        pieces.join(first.corner / 3, side.corner / 3);
      }
      const std::size_t count = end - i;
      if (count == 1) boundary.push_back(&first);
      if (count == 2 && first.upward == sides.items[i + 1].upward) ++result.inconsistent_edges;
      if (count > 2) ++result.nonmanifold_edges;
      i = end;
    }
  }

  for (std::uint32_t t = 0; t < corner_count / 3; ++t) result.components += pieces.root(t) == t;
  result.nonmanifold_vertices =
      count_vertices_of_several_fans(triangles, fans, mesh.vertex_count());
  result.boundary_edges = static_cast<Index>(boundary.size());
  std::vector<BoundaryEdge> edges;
  for (const Side* side : boundary) {
    const auto t = static_cast<Index>(side->corner / 3);
    const auto c = static_cast<int>(side->corner % 3);
    edges.push_back({fans.root(low_corner(*side)), fans.root(high_corner(*side)),
                     (mesh.corner(t, c) - mesh.corner(t, (c + 1) % 3)).norm()});
  }
  result.boundary_loops = loop_lengths(edges, corner_count);
  return result;
}

Index count_duplicate_triangles(TriangleView triangles, Index vertex_count, int num_threads) {
  using Pair = std::pair<std::int32_t, std::int32_t>;
  const auto list = list_by_vertex<Pair>(vertex_count, num_threads, [&](const auto& emit) {
    for (Index t = 0; t < triangles.rows(); ++t) {
      std::int32_t corners[3] = {triangles(t, 0), triangles(t, 1), triangles(t, 2)};
      std::sort(corners, corners + 3);
      emit(corners[0], Pair(corners[1], corners[2]));
    }
  });
  Index count = 0;
  for (std::size_t v = 0; v + 1 < list.start.size(); ++v) {
    for (std::size_t i = list.start[v] + 1; i < list.start[v + 1]; ++i) {
      count += list.items[i] == list.items[i - 1];
    }
  }
  return count;
}

}  // namespace bathyal::geometry
