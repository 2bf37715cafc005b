// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/chain.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace bathyal::scene {
namespace {

/// End 0 or 1 of a segment: 2 · segment + end.
using SegmentEnd = std::int32_t;
constexpr SegmentEnd kNone = -1;

constexpr SegmentEnd other_end(SegmentEnd end) { return end ^ 1; }

class Chainer {
 public:
  Chainer(const std::vector<Vec3>& points, const std::vector<CutSegment>& segments,
          const Vec3& along, const Vec3& normal)
      : points_(points),
        segments_(segments),
        along_(along),
        normal_(normal),
        partner_(2 * segments.size(), kNone),
        taken_(segments.size(), false) {}

  std::vector<Polyline> run() {
    pair_ends();
    std::vector<Polyline> lines;
    const auto count = static_cast<SegmentEnd>(partner_.size());
    for (SegmentEnd end = 0; end < count; ++end) {  // open lines, from either of their ends
      if (partner_[index(end)] == kNone && !taken_[index(end / 2)]) lines.push_back(open_line(end));
    }
    for (SegmentEnd end = 0; end < count; end += 2) {  // the remaining segments form closed lines
      if (!taken_[index(end / 2)]) lines.push_back(closed_line(end));
    }
    std::sort(lines.begin(), lines.end(), [this](const Polyline& a, const Polyline& b) {
      if (a.mesh.front() != b.mesh.front()) return a.mesh.front() < b.mesh.front();
      if (a.points[0] != b.points[0]) return before(a.points[0], b.points[0]);
      return before(a.points[1], b.points[1]);
    });
    return lines;
  }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  std::int32_t point_of(SegmentEnd end) const {
    return segments_[index(end / 2)].ends[index(end % 2)];
  }
  const Vec3& position(SegmentEnd end) const { return points_[index(point_of(end))]; }

  bool before(const Vec3& a, const Vec3& b) const {
    return std::make_tuple(along_.dot(a), a.x(), a.y(), a.z()) <
           std::make_tuple(along_.dot(b), b.x(), b.y(), b.z());
  }

  /// Gives each segment's end the end it goes on into.
  void pair_ends() {
    std::vector<std::int32_t> begin(points_.size() + 1, 0);
    const auto count = static_cast<SegmentEnd>(partner_.size());
    for (SegmentEnd end = 0; end < count; ++end) ++begin[index(point_of(end)) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<SegmentEnd> ends(partner_.size());
    std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
    for (SegmentEnd end = 0; end < count; ++end) ends[index(next[index(point_of(end))]++)] = end;
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const auto meeting = begin[p + 1] - begin[p];
      const SegmentEnd* first = ends.data() + begin[p];
      if (meeting == 2) join(first[0], first[1]);
      if (meeting > 2) pair_junction({first, first + meeting});
    }
  }

  void join(SegmentEnd a, SegmentEnd b) {
    partner_[index(a)] = b;
    partner_[index(b)] = a;
  }

  /// Joins the ends that are each other's straightest continuation until at most one is left. The
  /// straightest pair of all is always such a pair, so every round joins at least one.
  void pair_junction(std::vector<SegmentEnd> ends) {
    const auto far_position = [this](SegmentEnd end) { return position(other_end(end)); };
    std::sort(ends.begin(), ends.end(),
              [&](SegmentEnd a, SegmentEnd b) { return before(far_position(a), far_position(b)); });
    while (ends.size() > 1) {
      std::vector<Vec3> leaving;
      for (const SegmentEnd end : ends) {
        leaving.push_back((far_position(end) - position(end)).normalized());
      }
      std::vector<std::size_t> best(ends.size());
      for (std::size_t i = 0; i < ends.size(); ++i) best[i] = straightest(leaving, i);
      std::vector<SegmentEnd> left;
      for (std::size_t i = 0; i < ends.size(); ++i) {
        if (best[best[i]] == i) {
          join(ends[i], ends[best[i]]);
        } else {
          left.push_back(ends[i]);
        }
      }
      ends = std::move(left);
    }
  }

  /// The direction most opposed to direction i; equal ones are ordered by the pair's numbers, so
  /// that both of a pair find the same.
  static std::size_t straightest(const std::vector<Vec3>& leaving, std::size_t i) {
    std::size_t best = i;
    std::tuple<double, std::size_t, std::size_t> best_turn{2.0, 0, 0};  // a cosine is at most 1
    for (std::size_t j = 0; j < leaving.size(); ++j) {
      if (j == i) continue;
      const std::tuple turn{leaving[i].dot(leaving[j]), std::min(i, j), std::max(i, j)};
      if (turn < best_turn) {
        best_turn = turn;
        best = j;
      }
    }
    return best;
  }

  /// Walks from `end` through its segment and on until the line ends or comes back.
  Polyline walk(SegmentEnd end) {
    route_.clear();
    for (; end != kNone && !taken_[index(end / 2)]; end = partner_[index(other_end(end))]) {
      taken_[index(end / 2)] = true;
      route_.push_back(end);
    }
    Polyline line;
    line.points.reserve(route_.size() + 1);
    line.mesh.reserve(route_.size());
    line.triangle.reserve(route_.size());
    line.points.push_back(position(route_.front()));
    for (const SegmentEnd from : route_) {
      line.points.push_back(position(other_end(from)));
      line.mesh.push_back(segments_[index(from / 2)].mesh);
      line.triangle.push_back(segments_[index(from / 2)].triangle);
    }
    return line;
  }

  Polyline open_line(SegmentEnd end) {
    Polyline line = walk(end);
    if (before(line.points.back(), line.points.front())) reverse(line);
    return line;
  }

  Polyline closed_line(SegmentEnd end) {
    Polyline line = walk(end);
    line.closed = true;
    start_at_first(line);
    // A loop may pass its first point twice; the segment that leaves it settles where to start.
    Polyline other = line;
    reverse(other);
    start_at_first(other);
    if (before(other.points[1], line.points[1])) std::swap(line, other);
    return signed_area(line) < 0.0 ? other : line;
  }

  /// Turns a closed line round until it starts at the point that comes first.
  void start_at_first(Polyline& line) const {
    line.points.pop_back();
    const std::size_t count = line.points.size();
    std::size_t first = 0;
    for (std::size_t i = 1; i < count; ++i) {
      const Vec3 &p = line.points[i], &best = line.points[first];
      if (before(p, best) ||
          (p == best && before(line.points[(i + 1) % count], line.points[(first + 1) % count]))) {
        first = i;
      }
    }
    const auto shift = static_cast<std::ptrdiff_t>(first);
    std::rotate(line.points.begin(), line.points.begin() + shift, line.points.end());
    std::rotate(line.triangle.begin(), line.triangle.begin() + shift, line.triangle.end());
    line.points.push_back(line.points.front());
  }

  static void reverse(Polyline& line) {
    std::reverse(line.points.begin(), line.points.end());
    std::reverse(line.triangle.begin(), line.triangle.end());
  }

  double signed_area(const Polyline& line) const {
    Vec3 area = Vec3::Zero();
    const Vec3& start = line.points.front();
    for (std::size_t i = 1; i + 1 < line.points.size(); ++i) {
      area += (line.points[i] - start).cross(line.points[i + 1] - start);
    }
    return normal_.dot(area);
  }

  const std::vector<Vec3>& points_;
  const std::vector<CutSegment>& segments_;
  Vec3 along_, normal_;
  std::vector<SegmentEnd> partner_;
  std::vector<char> taken_;
  std::vector<SegmentEnd>
      route_;  ///< segments of the line at hand, by the ends they are entered at
};

}  // namespace

std::vector<Polyline> chain_segments(const std::vector<Vec3>& points,
                                     const std::vector<CutSegment>& segments, const Vec3& along,
                                     const Vec3& normal) {
  return Chainer(points, segments, along, normal).run();
}

}  // namespace bathyal::scene
