// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/geometry/mesh_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "bathyal/base/parallel.hpp"
#include "bathyal/geometry/internal/edge_topology.hpp"
#include "bathyal/geometry/internal/shadow_area.hpp"

namespace bathyal {
namespace {

using namespace geometry;

constexpr std::size_t kTriangleGrain = 8192;
constexpr double kFlat = 1e-12;  // height over longest edge below which a triangle has no area
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// What a mesh adds up to, triangle by triangle.
struct Sums {
  double area = 0.0, inverted_area = 0.0, slope_area = 0.0, volume = 0.0, slope_max = 0.0;
  Index zero = 0, inverted = 0;

  Sums& operator+=(const Sums& other) {
    area += other.area;
    inverted_area += other.inverted_area;
    slope_area += other.slope_area;
    volume += other.volume;
    slope_max = std::max(slope_max, other.slope_max);
    zero += other.zero;
    inverted += other.inverted;
    return *this;
  }
};

/// Slope and area of one triangle; area 0 for one that counts as having none.
struct Facet {
  double slope = 0.0, area = 0.0;
};

Facet facet_of(const TriangleMesh& mesh, Index t, const Vec3& twice_area) {
  const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  const double length = twice_area.norm();
  if (!(length > kFlat * longest)) return {};
  const double across = std::hypot(twice_area.x(), twice_area.y());
  return {std::atan2(across, twice_area.z()), 0.5 * length};
}

Sums sum_facets(const TriangleMesh& mesh, std::vector<Facet>& facets, int num_threads) {
  const Vec3 origin = local_origin(mesh.vertices());
  return parallel_sum<Sums>(facets.size(), kTriangleGrain, num_threads,
                            [&](std::size_t begin, std::size_t end) {
                              Sums sums;
                              for (std::size_t i = begin; i < end; ++i) {
                                const auto t = static_cast<Index>(i);
                                const Vec3 twice_area = mesh.area_vector(t);
                                const Facet facet = facets[i] = facet_of(mesh, t, twice_area);
                                if (facet.area == 0.0) {
                                  ++sums.zero;
                                  continue;
                                }
                                sums.area += facet.area;
                                sums.slope_area += facet.slope * facet.area;
                                sums.slope_max = std::max(sums.slope_max, facet.slope);
                                sums.volume += (mesh.corner(t, 0) - origin).dot(twice_area) / 6.0;
                                if (twice_area.z() < 0.0) {
                                  ++sums.inverted;
                                  sums.inverted_area += facet.area;
                                }
                              }
                              return sums;
                            });
}

/// The slope below which `share` of the area lies. A histogram finds the narrow band it is in, and
/// only that band is sorted.
double slope_quantile(const std::vector<Facet>& facets, double total, double share) {
  constexpr std::size_t kBins = 4096;
  const auto bin_of = [](double slope) {
    const double place = slope / std::numbers::pi * static_cast<double>(kBins);
    return std::min(kBins - 1, static_cast<std::size_t>(place));
  };
  std::array<double, kBins> histogram{};
  for (const Facet& f : facets) histogram[bin_of(f.slope)] += f.area;
  double below = 0.0;
  std::size_t bin = 0;
  while (bin + 1 < kBins && below + histogram[bin] < share * total) below += histogram[bin++];
  std::vector<Facet> band;
  for (const Facet& f : facets) {
    if (f.area > 0.0 && bin_of(f.slope) == bin) band.push_back(f);
  }
  std::stable_sort(band.begin(), band.end(),
                   [](const Facet& a, const Facet& b) { return a.slope < b.slope; });
  for (const Facet& f : band) {
    below += f.area;
    if (below >= share * total) return f.slope;
  }
  return band.empty() ? kNaN : band.back().slope;
}

/// Bounding box of the vertices in use, and how many are not.
void measure_vertices(const TriangleMesh& mesh, MeshReport& report) {
  std::vector<bool> used(static_cast<std::size_t>(mesh.vertex_count()), false);
  const TriangleView triangles = mesh.triangles();
  for (Index i = 0; i < triangles.size(); ++i) {
    used[static_cast<std::size_t>(triangles.data()[i])] = true;
  }
  report.unused_vertices = std::count(used.begin(), used.end(), false);
  if (report.unused_vertices == report.vertex_count) return;
  report.low.setConstant(std::numeric_limits<double>::infinity());
  report.high = -report.low;
  for (Index v = 0; v < report.vertex_count; ++v) {
    if (!used[static_cast<std::size_t>(v)]) continue;
    const Vec3 p = mesh.vertices().row(v);
    report.low = report.low.cwiseMin(p);
    report.high = report.high.cwiseMax(p);
  }
}

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string degrees(double radians) { return text("%.1f°", radians * 180.0 / std::numbers::pi); }

}  // namespace

MeshReport mesh_report(const TriangleMesh& mesh, int num_threads) {
  resolve_threads(num_threads);
  MeshReport report;
  report.vertex_count = mesh.vertex_count();
  report.triangle_count = mesh.triangle_count();
  measure_vertices(mesh, report);

  std::vector<Facet> facets(static_cast<std::size_t>(mesh.triangle_count()));
  const Sums sums = sum_facets(mesh, facets, num_threads);
  const bool has_area = sums.area > 0.0;
  report.area = sums.area;
  report.planar_area = shadow_area(mesh, num_threads);
  report.rugosity = report.planar_area > 0.0 ? report.area / report.planar_area : kNaN;
  report.zero_area_triangles = sums.zero;
  report.inverted_triangles = sums.inverted;
  report.area_share_inverted = has_area ? sums.inverted_area / sums.area : kNaN;
  report.slope_mean = has_area ? sums.slope_area / sums.area : kNaN;
  report.slope_median = has_area ? slope_quantile(facets, sums.area, 0.5) : kNaN;
  report.slope_p95 = has_area ? slope_quantile(facets, sums.area, 0.95) : kNaN;
  report.slope_max = has_area ? sums.slope_max : kNaN;

  EdgeTopology edges = edge_topology(mesh, num_threads);
  report.components = edges.components;
  report.boundary_loops = std::move(edges.boundary_loops);
  report.boundary_edges = edges.boundary_edges;
  report.nonmanifold_edges = edges.nonmanifold_edges;
  report.nonmanifold_vertices = edges.nonmanifold_vertices;
  report.inconsistent_edges = edges.inconsistent_edges;
  report.duplicate_triangles =
      count_duplicate_triangles(mesh.triangles(), mesh.vertex_count(), num_threads);
  report.closed = mesh.triangle_count() > 0 && edges.boundary_edges == 0 &&
                  edges.nonmanifold_edges == 0 && edges.inconsistent_edges == 0;
  report.volume = report.closed ? sums.volume : kNaN;
  return report;
}

std::string describe(const MeshReport& r) {
  const auto line = [](const std::string& name, const std::string& value) {
    return name + std::string(name.size() < 14 ? 14 - name.size() : 1, ' ') + value + "\n";
  };
  double rim = 0.0;
  for (const double length : r.boundary_loops) rim += length;
  const Vec3 size = r.high - r.low;
  std::string result =
      line("vertices", std::to_string(r.vertex_count) + " (" + std::to_string(r.unused_vertices) +
                           " in no triangle)") +
      line("triangles", std::to_string(r.triangle_count) + " (" +
                            std::to_string(r.zero_area_triangles) + " without area, " +
                            std::to_string(r.duplicate_triangles) + " duplicate)") +
      line("size", text("%.6g", size.x()) + " x " + text("%.6g", size.y()) + " x " +
                       text("%.6g m", size.z())) +
      line("area", text("%.6g m²", r.area) + " over " + text("%.6g m²", r.planar_area) +
                       " in plan, rugosity " + text("%.4g", r.rugosity)) +
      line("slope", "mean " + degrees(r.slope_mean) + ", median " + degrees(r.slope_median) +
                        ", 95 % below " + degrees(r.slope_p95) + ", max " + degrees(r.slope_max)) +
      line("facing down", std::to_string(r.inverted_triangles) + " triangles, " +
                              text("%.1f %% of the area", 100.0 * r.area_share_inverted)) +
      line("pieces", std::to_string(r.components)) +
      line("rims", std::to_string(r.boundary_loops.size()) + text(", %.6g m together", rim)) +
      line("not manifold", std::to_string(r.nonmanifold_edges) + " edges, " +
                               std::to_string(r.nonmanifold_vertices) + " vertices, " +
                               std::to_string(r.inconsistent_edges) +
                               " edges turned inconsistently") +
      line("closed", r.closed ? text("yes, volume %.6g m³", r.volume) : "no");
  result.pop_back();
  return result;
}

}  // namespace bathyal
