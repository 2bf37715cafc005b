// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/terrain/internal/triangulate_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "bathyal/base/parallel.hpp"
#include "bathyal/terrain/internal/triangulator.hpp"

namespace bathyal::terrain {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr std::size_t kSample = 4096;  // points looked at to place the cuts
constexpr std::size_t kTriangleGrain = 1 << 15;

/// The same triangle, beginning with its lowest vertex.
Corners lowest_first(const Corners& t) {
  if (t[0] < t[1] && t[0] < t[2]) return t;
  if (t[1] < t[2]) return {t[1], t[2], t[0]};
  return {t[2], t[0], t[1]};
}

/// low ≤ x < high, the same for y; infinite where no cut was made.
struct CellBox {
  double x_low = -kUnbounded, x_high = kUnbounded;
  double y_low = -kUnbounded, y_high = kUnbounded;

  bool holds(const Point2& p) const {
    return p.x >= x_low && p.x < x_high && p.y >= y_low && p.y < y_high;
  }
  bool is_plane() const {
    return x_low == -kUnbounded && x_high == kUnbounded && y_low == -kUnbounded &&
           y_high == kUnbounded;
  }
  double distance_to_cut(const Point2& p) const {
    return std::min(std::min(p.x - x_low, x_high - p.x), std::min(p.y - y_low, y_high - p.y));
  }
};

/// One box, what was made of its points, and which of it is not yet known to be final.
struct Cell {
  CellBox box;
  PageVector<Corners> triangles;  ///< those to leave out carry a ghost
  std::vector<Corners> open;      ///< not final, lowest vertex first, sorted
};

/// Median cuts through a sample, across the longer side, until there are `count` boxes.
void cut(std::span<Point2> sample, const CellBox& box, int count, std::vector<Cell>& cells) {
  if (count == 1 || sample.empty()) {
    cells.push_back({box, {}, {}});
    return;
  }
  const auto by_x = [](const Point2& a, const Point2& b) { return a.x < b.x; };
  const auto by_y = [](const Point2& a, const Point2& b) { return a.y < b.y; };
  const auto [left, right] = std::minmax_element(sample.begin(), sample.end(), by_x);
  const auto [bottom, top] = std::minmax_element(sample.begin(), sample.end(), by_y);
  const bool across_x = right->x - left->x >= top->y - bottom->y;
  const int first = count / 2;
  const std::size_t middle = sample.size() * static_cast<std::size_t>(first) / count;
  const auto at = sample.begin() + static_cast<std::ptrdiff_t>(middle);
  CellBox low = box, high = box;
  if (across_x) {
    std::nth_element(sample.begin(), at, sample.end(), by_x);
    low.x_high = high.x_low = at->x;
  } else {
    std::nth_element(sample.begin(), at, sample.end(), by_y);
    low.y_high = high.y_low = at->y;
  }
  cut(sample.first(middle), low, first, cells);
  cut(sample.subspan(middle), high, count - first, cells);
}

std::vector<Cell> make_cells(std::span<const Point2> points, int count) {
  std::vector<Point2> sample;
  const std::size_t step = points.size() / kSample + 1;
  for (std::size_t i = 0; i < points.size() && count > 1; i += step) sample.push_back(points[i]);
  std::vector<Cell> cells;
  cut(sample, {}, count, cells);
  return cells;
}

PageVector<std::int32_t> vertices_within(std::span<const Point2> points, const CellBox& box) {
  PageVector<std::int32_t> vertices;
  vertices.reserve(points.size());  // what stays empty is never touched
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (box.holds(points[i])) vertices.push_back(static_cast<std::int32_t>(i));
  }
  return vertices;
}

/// Whether the circle through a, b, c lies within the box for certain. It reaches no further from a
/// than its diameter |ab| |bc| |ca| / (2 area); the margin is far above the rounding of all of it,
/// and lengths whose products could leave the range of a double count as not certain.
bool is_final(const Point2& a, const Point2& b, const Point2& c, const CellBox& box) {
  const double abx = b.x - a.x, aby = b.y - a.y;
  const double acx = c.x - a.x, acy = c.y - a.y;
  const double bcx = c.x - b.x, bcy = c.y - b.y;
  const double ab = abx * abx + aby * aby;
  const double ac = acx * acx + acy * acy;
  const double bc = bcx * bcx + bcy * bcy;
  const double left = abx * acy, right = aby * acx;
  const double double_area =
      (left - right) - 4.0 * exact::kOrientError * (std::fabs(left) + std::fabs(right));
  if (!(std::min({ab, ac, bc}) > 1e-90 && std::max({ab, ac, bc}) < 1e90 && double_area > 0.0)) {
    return false;
  }
  const double reach = box.distance_to_cut(a) * double_area;
  return ab * ac * bc < 0.99 * reach * reach;
}

/// Which vertices take part in the common triangulation, by the number of their cell plus 1; 0 for
/// those whose triangles are all final.
using Seam = PageVector<std::uint16_t>;

/// Triangulates a cell; triangles that are not final go to `open` and their vertices to the seam.
void triangulate_cell(std::span<const Point2> points, Cell& cell, std::uint16_t mark, Seam& seam) {
  const PageVector<std::int32_t> vertices = vertices_within(points, cell.box);
  cell.triangles = triangulate_points(points, vertices);
  if (cell.triangles.empty()) {
    for (const std::int32_t v : vertices) seam[v] = mark;
  }
  if (cell.box.is_plane()) return;
  for (Corners& t : cell.triangles) {
    if (is_ghost(t)) {
      for (const std::int32_t v : t) {
        if (v != kGhost) seam[v] = mark;
      }
    } else if (!is_final(points[t[0]], points[t[1]], points[t[2]], cell.box)) {
      for (const std::int32_t v : t) seam[v] = mark;
      cell.open.push_back(lowest_first(t));
      t[0] = kGhost;
    }
  }
  std::sort(cell.open.begin(), cell.open.end());
}

/// The triangles that no cell could settle. In the triangulation of the seam's vertices these are
/// the ones that join cells, and those that their own cell had found too.
PageVector<Corners> triangulate_seam(std::span<const Point2> points, const std::vector<Cell>& cells,
                                     const Seam& seam) {
  std::vector<std::int32_t> vertices;
  for (std::size_t i = 0; i < seam.size(); ++i) {
    if (seam[i] != 0) vertices.push_back(static_cast<std::int32_t>(i));
  }
  PageVector<Corners> triangles = triangulate_points(points, vertices);
  for (Corners& t : triangles) {
    if (is_ghost(t)) continue;
    const std::uint16_t mark = seam[t[0]];
    if (seam[t[1]] != mark || seam[t[2]] != mark) continue;
    const std::vector<Corners>& open = cells[mark - 1].open;
    if (!std::binary_search(open.begin(), open.end(), lowest_first(t))) {
      t[0] = kGhost;
    }
  }
  return triangles;
}

/// The triangles that begin with one vertex, in order: two of them on average, which is no work for
/// a general sort, and all of them around the hub of a fan, which is.
void sort_bucket(Corners* first, Corners* last) {
  constexpr std::ptrdiff_t kFew = 8;
  if (last - first > kFew) return std::sort(first, last);
  for (Corners* next = first; next < last; ++next) {
    for (Corners* t = next; t > first && t[0] < t[-1]; --t) std::swap(t[0], t[-1]);
  }
}

/// Counting sort by lowest vertex. The cells' triangles have theirs in different places and go side
/// by side; `seam` goes by itself.
class Ordering {
 public:
  Ordering(std::size_t vertex_count, const std::vector<Cell>& cells,
           const PageVector<Corners>& seam, int num_threads)
      : cells_(cells), seam_(seam), num_threads_(num_threads), place_(vertex_count + 1, 0) {}

  TriangleMatrix run() {
    for_all([&](const Corners& t) { ++place_[static_cast<std::size_t>(t[0]) + 1]; });
    for (std::size_t v = 1; v < place_.size(); ++v) place_[v] += place_[v - 1];
    TriangleMatrix matrix(static_cast<Index>(place_.back()), 3);
    static_assert(sizeof(Corners) == 3 * sizeof(std::int32_t));
    auto* sorted = reinterpret_cast<Corners*>(matrix.data());
    for_all([&](const Corners& t) { sorted[place_[static_cast<std::size_t>(t[0])]++] = t; });
    // place_[v] has come to where the triangles of v end.
    parallel_for(place_.size() - 1, kTriangleGrain, num_threads_,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t v = begin; v < end; ++v) {
                     sort_bucket(sorted + (v == 0 ? 0 : place_[v - 1]), sorted + place_[v]);
                   }
                 });
    return matrix;
  }

 private:
  template <class Visit>
  void for_all(const Visit& visit) const {
    const auto visit_part = [&](const PageVector<Corners>& part) {
      for (const Corners& t : part) {
        if (!is_ghost(t)) visit(lowest_first(t));
      }
    };
    parallel_for(cells_.size(), 1, num_threads_,
                 [&](std::size_t i, std::size_t) { visit_part(cells_[i].triangles); });
    visit_part(seam_);
  }

  const std::vector<Cell>& cells_;
  const PageVector<Corners>& seam_;
  int num_threads_;
  PageVector<std::uint32_t> place_;  ///< where the next triangle of a vertex goes
};

}  // namespace

TriangleMatrix triangulate_in_cells(std::span<const Point2> points, int cells, int num_threads) {
  std::vector<Cell> parts = make_cells(points, cells);
  PageVector<Corners> seam_triangles;
  Seam seam(points.size(), 0);
  parallel_for(parts.size(), 1, num_threads, [&](std::size_t i, std::size_t) {
    triangulate_cell(points, parts[i], static_cast<std::uint16_t>(i + 1), seam);
  });
  if (parts.size() > 1) seam_triangles = triangulate_seam(points, parts, seam);
  return Ordering(points.size(), parts, seam_triangles, num_threads).run();
}

}  // namespace bathyal::terrain
