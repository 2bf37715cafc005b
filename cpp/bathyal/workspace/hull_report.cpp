// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/workspace/hull_report.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "bathyal/base/text.hpp"
#include "bathyal/workspace/internal/triangle_pairs.hpp"
#include "bathyal/workspace/internal/welded_mesh.hpp"

namespace bathyal {
namespace {

using workspace::EdgeReport;
using workspace::WeldedMesh;

// Sizes of vehicles; beyond them the file's unit was probably taken for another [m].
constexpr double kLargestHull = 100.0;
constexpr double kSmallestHull = 0.05;
constexpr double kFarFromOrigin = 20.0;  ///< of the hull's size

void measure_triangles(const WeldedMesh& mesh, const EdgeReport& edges, HullReport& report) {
  const Eigen::AlignedBox3d box = mesh.box();
  if (box.isEmpty()) return;
  report.low = box.min();
  report.high = box.max();
  const Vec3 middle = box.center();
  std::vector<double> volume(static_cast<std::size_t>(edges.parts));
  double total = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - middle;
    const Vec3 b = mesh.corner(t, 1) - middle;
    const Vec3 c = mesh.corner(t, 2) - middle;
    const Vec3 normal = (b - a).cross(c - a);
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    constexpr double kFlat = 1e-12;
    report.degenerate_triangles += !(normal.norm() > kFlat * longest);
    report.area += 0.5 * normal.norm();
    volume[static_cast<std::size_t>(edges.part[t])] += a.dot(normal) / 6.0;
  }
  for (const double part : volume) total += part;
  report.inside_out = total < 0.0;
  report.volume = report.closed ? std::abs(total) : std::numeric_limits<double>::quiet_NaN();
  if (!report.closed) return;
  report.opposed_parts =
      std::count_if(volume.begin(), volume.end(), [&](double part) { return part * total < 0.0; });
}

void count_crossings(const WeldedMesh& mesh, const EdgeReport& edges, int num_threads,
                     HullReport& report) {
  std::set<std::pair<std::int32_t, std::int32_t>> parts;
  for (const auto& [first, second] : workspace::intersecting_pairs(mesh, num_threads)) {
    ++report.intersecting_pairs;
    const std::int32_t a = edges.part[static_cast<std::size_t>(first)];
    const std::int32_t b = edges.part[static_cast<std::size_t>(second)];
    if (a != b) parts.insert(std::minmax(a, b));
  }
  report.overlapping_parts = static_cast<Index>(parts.size());
}

std::string metres(double value) { return three_digits(value) + " m"; }

std::vector<std::string> surface_warnings(const HullReport& r) {
  std::vector<std::string> warnings;
  if (r.boundary_edges > 0) {
    warnings.push_back("The surface is open at " + counted(r.boundary_edges, "edge") +
                       ": inside is what films over the holes would hold.");
  }
  if (r.inconsistent_edges > 0) {
    warnings.push_back("The triangles at " + counted(r.inconsistent_edges, "edge") +
                       " are wound against each other: inside is uncertain near them.");
  }
  if (!r.closed && r.boundary_edges == 0 && r.inconsistent_edges == 0) {
    warnings.push_back("More triangles run one way than the other along " +
                       counted(r.open_edges, "edge") + ": inside is uncertain near them.");
  }
  if (r.inside_out) warnings.push_back("The normals point inwards: the mesh is inside out.");
  if (r.intersecting_pairs > 0) {
    warnings.push_back("The surface intersects itself: " + counted(r.intersecting_pairs, "pair") +
                       " of triangles.");
  }
  if (r.overlapping_parts > 0) {
    warnings.push_back(counted(r.overlapping_parts, "pair") + " of its " + std::to_string(r.parts) +
                       " parts overlap: the volume counts twice there.");
  }
  if (r.opposed_parts > 0) {
    warnings.push_back(counted(r.opposed_parts, "part") +
                       " wound against the whole: a cavity, or a part that is inside out.");
  }
  if (r.degenerate_triangles > 0) {
    warnings.push_back(counted(r.degenerate_triangles, "triangle") + " without area.");
  }
  return warnings;
}

/// Whether size and place are those of a vehicle's hull.
void add_plausibility(HullReport& r) {
  const double size = (r.high - r.low).maxCoeff();
  if (size > kLargestHull) {
    r.warnings.push_back("It is " + metres(size) + " long: were millimetres taken for metres?");
  } else if (size < kSmallestHull) {
    r.warnings.push_back("It is " + metres(size) + " long: were metres taken for millimetres?");
  }
  const double distance = Eigen::AlignedBox3d(r.low, r.high).exteriorDistance(Vec3(Vec3::Zero()));
  if (distance > kFarFromOrigin * size) {
    r.warnings.push_back("It lies " + metres(distance) +
                         " from the origin: is it given in the vehicle's frame?");
  }
}

}  // namespace

HullReport hull_report(const TriangleMesh& mesh, int num_threads) {
  const WeldedMesh welded(mesh);
  const EdgeReport edges = workspace::edge_report(welded);
  HullReport report;
  report.triangle_count = mesh.triangle_count();
  report.closed = edges.open.empty();
  report.open_edges = static_cast<Index>(edges.open.size());
  report.boundary_edges = static_cast<Index>(edges.boundary);
  report.nonmanifold_edges = static_cast<Index>(edges.nonmanifold);
  report.inconsistent_edges = static_cast<Index>(edges.inconsistent);
  report.parts = edges.parts;
  measure_triangles(welded, edges, report);
  count_crossings(welded, edges, num_threads, report);
  report.warnings = surface_warnings(report);
  add_plausibility(report);
  return report;
}

std::string describe(const HullReport& r) {
  const Vec3 size = r.high - r.low;
  std::string text = counted(r.triangle_count, "triangle") + " in " + counted(r.parts, "part") +
                     ", " + three_digits(size.x()) + " x " + three_digits(size.y()) + " x " +
                     three_digits(size.z()) + " m";
  text += r.closed ? ", closed, volume " + three_digits(r.volume) + " m3" : ", open";
  for (const std::string& warning : r.warnings) text += "\n- " + warning;
  return text;
}

}  // namespace bathyal
