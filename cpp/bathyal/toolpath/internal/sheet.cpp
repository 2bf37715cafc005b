// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/sheet.hpp"

#include <algorithm>
#include <cmath>

namespace bathyal::toolpath {
namespace {

/// A point on a polyline: on segment `segment`, at `fraction` of its length.
struct Place {
  std::size_t line = 0;
  std::size_t segment = 0;
  double fraction = 0.0;
  bool found = false;
};

/// How far a target may lie off the section and still belong to it: rounding of far coordinates.
double tolerance(const Vec3& point) { return kCoincident + 1e-12 * point.cwiseAbs().maxCoeff(); }

/// The place on the section where the target lies; of equally near ones that on its own facet.
Place locate(const std::vector<Polyline>& lines, const SheetPoint& target) {
  const double near = tolerance(target.point);
  Place best;
  double best_distance = near;
  bool best_own = false;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    const Polyline& line = lines[l];
    for (std::size_t s = 0; s + 1 < line.points.size(); ++s) {
      const Vec3 edge = line.points[s + 1] - line.points[s];
      const double squared = edge.squaredNorm();
      const double along = edge.dot(target.point - line.points[s]);
      const double fraction = squared > 0.0 ? std::clamp(along / squared, 0.0, 1.0) : 0.0;
      const double distance = (line.points[s] + fraction * edge - target.point).norm();
      if (distance > near) continue;
      const bool own = line.mesh[s] == target.mesh && line.triangle[s] == target.triangle;
      if (best.found && (best_own > own || (best_own == own && best_distance <= distance)))
        continue;
      best = {l, s, fraction, true};
      best_distance = distance;
      best_own = own;
    }
  }
  return best;
}

Place first_place(std::size_t line) { return {line, 0, 0.0, true}; }
Place last_place(const std::vector<Polyline>& lines, std::size_t line) {
  return {line, lines[line].points.size() - 2, 1.0, true};
}

bool before(const Place& a, const Place& b) {
  return a.segment != b.segment ? a.segment < b.segment : a.fraction < b.fraction;
}

Vec3 point_at(const Polyline& line, const Place& place) {
  return line.points[place.segment] +
         place.fraction * (line.points[place.segment + 1] - line.points[place.segment]);
}

Piece piece_of(const Polyline& line, std::size_t segment) {
  Piece piece;
  piece.from = line.points[segment];
  piece.to = line.points[segment + 1];
  piece.mesh = line.mesh[segment];
  piece.triangle = line.triangle[segment];
  return piece;
}

/// The pieces of the line from `a` on to `b`, which is not before it.
std::vector<Piece> pieces_ahead(const Polyline& line, const Place& a, const Place& b) {
  std::vector<Piece> pieces;
  for (std::size_t s = a.segment; s <= b.segment; ++s) pieces.push_back(piece_of(line, s));
  pieces.front().from = point_at(line, a);
  pieces.back().to = point_at(line, b);
  return pieces;
}

std::vector<Piece> reversed(std::vector<Piece> pieces) {
  std::reverse(pieces.begin(), pieces.end());
  for (Piece& piece : pieces) std::swap(piece.from, piece.to);
  return pieces;
}

double length_of(const std::vector<Piece>& pieces) {
  double length = 0.0;
  for (const Piece& piece : pieces) length += piece.length();
  return length;
}

/// Along one line from a to b; round a closed one by the shorter way.
std::vector<Piece> walk(const std::vector<Polyline>& lines, const Place& a, const Place& b) {
  const Polyline& line = lines[a.line];
  if (before(b, a)) return reversed(walk(lines, b, a));
  std::vector<Piece> ahead = pieces_ahead(line, a, b);
  if (!line.closed) return ahead;
  std::vector<Piece> round = pieces_ahead(line, b, last_place(lines, a.line));
  const std::vector<Piece> rest = pieces_ahead(line, first_place(a.line), a);
  round.insert(round.end(), rest.begin(), rest.end());
  return length_of(round) < length_of(ahead) ? reversed(std::move(round)) : ahead;
}

/// Begins and ends at the targets themselves; what is shorter than kCoincident is dropped.
Run tidy(std::vector<Piece> pieces, const Vec3& begin, const Vec3& end) {
  Run run;
  Vec3 at = begin;
  for (Piece& piece : pieces) {
    piece.from = at;
    if (piece.length() <= kCoincident) continue;
    at = piece.to;
    run.pieces.push_back(piece);
  }
  if (run.pieces.empty()) {
    pieces.resize(1);
    run.pieces = std::move(pieces);
  }
  run.pieces.back().to = end;
  return run;
}

Run lone(const SheetPoint& target) {
  Piece piece;
  piece.from = piece.to = target.point;
  piece.mesh = target.mesh;
  piece.triangle = target.triangle;
  return {{piece}, -1};
}

/// r of the paper. See follow_sheet for a above b.
Vec3 plane_normal(const SheetPoint& a, const SheetPoint& b, const Vec3& up) {
  const Vec3 r = (b.point - a.point).cross(up);
  if (r.norm() > tolerance(a.point)) return r.normalized();
  const Vec3 level = (a.normal + b.normal).cross(up);
  if (level.norm() > 1e-6) return level.normalized();
  Index axis = 0;
  up.cwiseAbs().minCoeff(&axis);
  return up.cross(Vec3::Unit(axis)).normalized();
}

/// The end of the line that lies furthest along (sign = 1) or back against (−1) `ahead`; the place
/// itself where the line is closed and has no end.
Place open_end(const std::vector<Polyline>& lines, const Place& place, const Vec3& ahead,
               double sign) {
  const Polyline& line = lines[place.line];
  if (line.closed) return place;
  const bool last_is_further = sign * ahead.dot(line.points.back() - line.points.front()) > 0.0;
  return last_is_further ? last_place(lines, place.line) : first_place(place.line);
}

/// Sheets between the open ends at `from` and `to`, in the order they are met, each walked ahead.
std::vector<Run> sheets_between(const std::vector<Polyline>& lines, std::size_t first,
                                std::size_t last, Vec3 from, const Vec3& to, const Vec3& ahead) {
  std::vector<Run> runs;
  std::vector<bool> used(lines.size(), false);
  used[first] = used[last] = true;
  for (;;) {
    double nearest = (to - from).norm();
    std::size_t next = lines.size();
    for (std::size_t l = 0; l < lines.size(); ++l) {
      if (used[l] || lines[l].closed || lines[l].points.size() < 2) continue;
      const Place begin = open_end(lines, first_place(l), ahead, -1.0);
      const Place end = open_end(lines, first_place(l), ahead, 1.0);
      const Vec3 p = point_at(lines[l], begin);
      if (ahead.dot(p - from) < 0.0 || ahead.dot(to - point_at(lines[l], end)) < 0.0) continue;
      if ((p - from).norm() >= nearest) continue;
      nearest = (p - from).norm();
      next = l;
    }
    if (next == lines.size()) return runs;
    used[next] = true;
    const Place begin = open_end(lines, first_place(next), ahead, -1.0);
    const Place end = open_end(lines, first_place(next), ahead, 1.0);
    from = point_at(lines[next], end);
    runs.push_back(tidy(walk(lines, begin, end), point_at(lines[next], begin), from));
  }
}

bool is_lone(const Run& run) { return run.pieces.size() == 1 && run.pieces[0].length() == 0.0; }

/// One run of those that follow each other without a gap: meshes that abut are one sheet.
std::vector<Run> abutted(std::vector<Run> runs) {
  std::vector<Run> joined;
  for (Run& run : runs) {
    const Vec3& begin = run.pieces.front().from;
    if (joined.empty() || (begin - joined.back().pieces.back().to).norm() > tolerance(begin)) {
      joined.push_back(std::move(run));
    } else if (is_lone(joined.back())) {
      run.pieces.front().from = joined.back().pieces.back().to;
      joined.back() = std::move(run);
    } else if (is_lone(run)) {
      joined.back().pieces.back().to = run.pieces.back().to;
    } else {
      std::vector<Piece>& pieces = joined.back().pieces;
      run.pieces.front().from = pieces.back().to;
      pieces.insert(pieces.end(), run.pieces.begin(), run.pieces.end());
    }
  }
  return joined;
}

/// Follows a's sheet to its open end and crosses, gap by gap, to b's.
std::vector<Run> cross_gaps(const std::vector<Polyline>& lines, const SheetPoint& a,
                            const SheetPoint& b, const Vec3& ahead) {
  const Place at_a = locate(lines, a), at_b = locate(lines, b);
  if (!at_a.found || !at_b.found || at_a.line == at_b.line) return {lone(a), lone(b)};
  const Place leave = open_end(lines, at_a, ahead, 1.0);
  const Place land = open_end(lines, at_b, ahead, -1.0);
  const Vec3 from = point_at(lines[leave.line], leave);
  const Vec3 to = point_at(lines[land.line], land);
  std::vector<Run> runs{tidy(walk(lines, at_a, leave), a.point, from)};
  for (Run& run : sheets_between(lines, at_a.line, at_b.line, from, to, ahead)) {
    runs.push_back(std::move(run));
  }
  runs.push_back(tidy(walk(lines, land, at_b), to, b.point));
  return abutted(std::move(runs));
}

/// One run where a single line of the section holds both targets, else none.
std::vector<Run> joined(const std::vector<Polyline>& lines, const SheetPoint& a,
                        const SheetPoint& b) {
  const Place at_a = locate(lines, a), at_b = locate(lines, b);
  if (!at_a.found || !at_b.found || at_a.line != at_b.line) return {};
  return {tidy(walk(lines, at_a, at_b), a.point, b.point)};
}

}  // namespace

Leg follow_sheet(const Scene& scene, const SheetPoint& a, const SheetPoint& b, const Vec3& up) {
  const Vec3 r = plane_normal(a, b, up);
  const bool vertical_pair = (b.point - a.point).cross(up).norm() <= tolerance(a.point);
  std::vector<Polyline> between;
  if (!vertical_pair) {
    between = scene.section(a.point, b.point, up);
    if (auto runs = joined(between, a, b); !runs.empty()) return {std::move(runs), false};
  }
  if (auto runs = joined(scene.section(Plane::through(a.point, r)), a, b); !runs.empty()) {
    return {std::move(runs), !vertical_pair};
  }
  if (vertical_pair) return {{lone(a), lone(b)}, false};
  return {cross_gaps(between, a, b, up.cross(r)), false};
}

}  // namespace bathyal::toolpath
