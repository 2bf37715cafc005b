// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/toolpath/internal/route.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "bathyal/base/parallel.hpp"
#include "bathyal/toolpath/internal/sheet.hpp"

namespace bathyal::toolpath {
namespace {

/// Two neighbouring targets that were found; aims without a target may lie between them.
struct Pair {
  std::size_t a, b;
};

SheetPoint sheet_point(const Targets& targets, std::size_t i) {
  return {targets.point[i], targets.normal[i], targets.mesh[i], targets.triangle[i]};
}

Run straight(const Targets& targets, std::size_t from, std::size_t to) {
  Piece piece;
  piece.from = targets.point[from];
  piece.to = targets.point[to];
  piece.mesh = targets.mesh[from];
  piece.triangle = targets.triangle[from];
  return {{piece}, -1};
}

/// Runs of one pair; none at all where the targets coincide.
Leg join(const Surface& surface, const Targets& targets, const Pair& pair, const Vec3& up) {
  if (pair.b != pair.a + 1) {
    return {{straight(targets, pair.a, pair.a), straight(targets, pair.b, pair.b)}, false};
  }
  if ((targets.point[pair.b] - targets.point[pair.a]).norm() <= kCoincident) return {};
  if (std::holds_alternative<Plane>(surface)) return {{straight(targets, pair.a, pair.b)}, false};
  return follow_sheet(std::get<Scene>(surface), sheet_point(targets, pair.a),
                      sheet_point(targets, pair.b), up);
}

void append(Route& route, Leg leg, std::int32_t segment) {
  for (std::size_t k = 0; k < leg.runs.size(); ++k) {
    for (Piece& piece : leg.runs[k].pieces) piece.segment = segment;
    if (k > 0) {
      route.runs.back().gap_segment = segment;
      route.runs.push_back(std::move(leg.runs[k]));
      continue;
    }
    std::vector<Piece>& before = route.runs.back().pieces;
    std::vector<Piece>& more = leg.runs[k].pieces;
    // A lone point is held only where nothing else leads to or from it.
    if (more.size() == 1 && more[0].length() == 0.0) continue;
    if (before.size() == 1 && before[0].length() == 0.0) before.clear();
    before.insert(before.end(), std::make_move_iterator(more.begin()),
                  std::make_move_iterator(more.end()));
  }
}

/// Facet normals; a facet without area, which has none, takes that of its neighbour on the path.
void set_facet_normals(Route& route, const Surface& surface, const Vec3& up) {
  for (Run& run : route.runs) {
    for (Piece& piece : run.pieces) {
      if (const auto* plane = std::get_if<Plane>(&surface)) {
        piece.normal = outward_normal(*plane, up);
      } else {
        piece.normal = outward_normal(std::get<Scene>(surface), piece.mesh, piece.triangle);
      }
    }
    auto& pieces = run.pieces;
    for (std::size_t k = 1; k < pieces.size(); ++k) {
      if (pieces[k].normal.isZero()) pieces[k].normal = pieces[k - 1].normal;
    }
    for (std::size_t k = pieces.size() - 1; k-- > 0;) {
      if (pieces[k].normal.isZero()) pieces[k].normal = pieces[k + 1].normal;
    }
    if (pieces[0].normal.isZero()) {
      for (Piece& piece : pieces) piece.normal = up;
    }
  }
}

/// "3", "3 and 8", "3, 8 and 9"; of many the first ten and how many there are.
std::string list_text(const std::vector<std::size_t>& numbers) {
  constexpr std::size_t kShown = 10;
  const std::size_t count = numbers.size(), shown = std::min(count, kShown);
  std::string text = std::to_string(numbers[0]);
  for (std::size_t k = 1; k < shown; ++k) {
    text += (k + 1 < count ? ", " : " and ") + std::to_string(numbers[k]);
  }
  return count > kShown ? text + ", … (" + std::to_string(count) + " in all)" : text;
}

void warn(Route& route, const std::string& noun, const std::vector<std::size_t>& numbers,
          const std::string& one, const std::string& several) {
  warn_of(route.warnings, noun, numbers, one, several);
}

void warn_of_targets(Route& route, const Targets& targets) {
  const auto aims_where = [&](const auto& condition) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      if (condition(i)) rows.push_back(i);
    }
    return rows;
  };
  const auto beneath = [&](std::size_t i) { return targets.incidence[i] > std::numbers::pi / 2; };
  for (const auto status :
       {TargetStatus::kMiss, TargetStatus::kParallel, TargetStatus::kBehind, TargetStatus::kHole}) {
    const std::string no_target = "no target (" + std::string(to_text(status)) + ")";
    warn(route, "aim", aims_where([&](std::size_t i) { return targets.status[i] == status; }),
         "has " + no_target + " and is left out", "have " + no_target + " and are left out");
  }
  warn(route, "aim", aims_where([&](std::size_t i) {
         return targets.status[i] == TargetStatus::kGrazing && !beneath(i);
       }),
       "grazes the bottom and is used", "graze the bottom and are used");
  const std::string why = " used: the camera is below it or the mesh is inside out";
  warn(route, "aim", aims_where(beneath), "strikes the bottom from beneath and is" + why,
       "strike the bottom from beneath and are" + why);
}

}  // namespace

void warn_of(std::vector<std::string>& warnings, const std::string& noun,
             const std::vector<std::size_t>& numbers, const std::string& one,
             const std::string& several) {
  if (numbers.empty()) return;
  const bool is_one = numbers.size() == 1;
  warnings.push_back(noun + (is_one ? " " : "s ") + list_text(numbers) + " " +
                     (is_one ? one : several));
}

Route join_targets(const Surface& surface, const Targets& targets, const Vec3& up,
                   int num_threads) {
  std::vector<Pair> pairs;
  std::size_t last = targets.size();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!targets.found(i)) continue;
    if (last < targets.size()) pairs.push_back({last, i});
    last = i;
  }
  std::vector<Leg> legs(pairs.size());
  parallel_for(pairs.size(), 8, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) legs[k] = join(surface, targets, pairs[k], up);
  });

  Route route;
  warn_of_targets(route, targets);
  std::vector<std::size_t> coincident, detours, gaps;
  const std::size_t first = pairs.empty() ? last : pairs[0].a;
  route.runs.push_back(straight(targets, first, first));
  route.runs[0].pieces[0].segment = static_cast<std::int32_t>(first);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (legs[k].runs.empty()) coincident.push_back(pairs[k].a);
    if (legs[k].runs.size() > 1) gaps.push_back(pairs[k].a);
    if (legs[k].detour) detours.push_back(pairs[k].a);
    append(route, std::move(legs[k]), static_cast<std::int32_t>(pairs[k].a));
  }
  warn(route, "segment", coincident, "has no length: its targets coincide",
       "have no length: their targets coincide");
  warn(route, "segment", gaps, "crosses a gap", "cross gaps");
  warn(route, "segment", detours, "leaves the stretch between its targets, round an overhang",
       "leave the stretch between their targets, round overhangs");
  set_facet_normals(route, surface, up);
  return route;
}

void subdivide(Route& route, double length) {
  for (Run& run : route.runs) {
    std::vector<Piece> parts;
    for (const Piece& piece : run.pieces) {
      const auto count =
          static_cast<std::size_t>(std::max(1.0, std::ceil(piece.length() / length)));
      for (std::size_t k = 0; k < count; ++k) {
        Piece part = piece;
        const Vec3 step = (piece.to - piece.from) / static_cast<double>(count);
        part.from = piece.from + static_cast<double>(k) * step;
        if (k + 1 < count) part.to = piece.from + static_cast<double>(k + 1) * step;
        parts.push_back(part);
      }
    }
    run.pieces = std::move(parts);
  }
}

}  // namespace bathyal::toolpath
