// SPDX-License-Identifier: BSD-3-Clause
// The 2.5-D Delaunay triangulation against CGAL's Delaunay_triangulation_2 (EPICK kernel, insertion
// of a range). CGAL is included here, in a benchmark that is not part of bathyal's libraries: its
// triangulation packages are GPL-3.0.
//
// Ours is timed whole, from an (N, 3) array to an ordered, trimmed (T, 3) array; CGAL's from a
// vector of its own points to its own structure, which it need not give out.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/version.h>
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/terrain/delaunay.hpp"

namespace {

using namespace bathyal;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Peer = CGAL::Delaunay_triangulation_2<Kernel>;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using PeerWithRows =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;
using Corners = std::array<std::int32_t, 3>;

PointMatrix uniform_soundings(Index count) {
  PointMatrix points(count, 3);
  RandomStream random(1);
  for (Index i = 0; i < count; ++i) {
    points.row(i) << random.uniform(0.0, 1000.0), random.uniform(0.0, 1000.0),
        random.uniform(-53.0, -51.0);
  }
  return points;
}

/// A 2 m grid in UTM coordinates, row by row, as gridded bathymetry comes.
PointMatrix utm_grid(Index rows, Index columns) {
  PointMatrix points(rows * columns, 3);
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j) {
      points.row(i * columns + j) << 620152.873 + 2.0 * static_cast<double>(j),
          7246504.912 + 2.0 * static_cast<double>(i), -52.0;
    }
  }
  return points;
}

/// Multibeam lines in the order a survey records them: 400 beams a ping, denser at nadir, ten
/// overlapping lines run to and fro, position noise, millimetres in the file.
PointMatrix survey_lines(Index pings) {
  constexpr Index kBeams = 400, kLines = 10;
  PointMatrix points(pings * kBeams, 3);
  RandomStream random(2);
  const Index pings_a_line = (pings + kLines - 1) / kLines;
  for (Index ping = 0; ping < pings; ++ping) {
    const Index line = ping / pings_a_line, step = ping % pings_a_line;
    const double along = 0.8 * static_cast<double>(line % 2 == 0 ? step : pings_a_line - step);
    for (Index beam = 0; beam < kBeams; ++beam) {
      const double angle = (static_cast<double>(beam) / (kBeams - 1) - 0.5) * 2.2;
      const double across = 60.0 * static_cast<double>(line) + 25.0 * std::tan(angle);
      const auto millimetres = [](double value) { return std::round(value * 1000.0) / 1000.0; };
      points.row(ping * kBeams + beam) << millimetres(5e5 + along + 0.05 * random.normal()),
          millimetres(6e6 + across + 0.05 * random.normal()), -25.0 + 0.02 * random.normal();
    }
  }
  return points;
}

std::vector<Peer::Point> peer_points(PointView points) {
  std::vector<Peer::Point> result;
  result.reserve(static_cast<std::size_t>(points.rows()));
  for (Index i = 0; i < points.rows(); ++i) result.emplace_back(points(i, 0), points(i, 1));
  return result;
}

/// For each row the first row with the same (x, y).
std::vector<std::int32_t> first_rows(PointView points) {
  std::vector<std::int32_t> order(static_cast<std::size_t>(points.rows()));
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](std::int32_t i) { return std::tuple(points(i, 0), points(i, 1)); };
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return place(a) < place(b) || (place(a) == place(b) && a < b);
  });
  std::vector<std::int32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool repeated = i > 0 && place(order[i]) == place(order[i - 1]);
    first[order[i]] = repeated ? first[order[i - 1]] : order[i];
  }
  return first;
}

/// CGAL breaks ties by the same rule, so that the sets of triangles must be equal to the last one.
bool same_triangles(PointView points, const Delaunay& ours) {
  std::vector<std::pair<Peer::Point, std::int32_t>> rows;
  for (Index i = 0; i < points.rows(); ++i) {
    rows.emplace_back(Peer::Point(points(i, 0), points(i, 1)), static_cast<std::int32_t>(i));
  }
  PeerWithRows peer(rows.begin(), rows.end());
  const std::vector<std::int32_t> first = first_rows(points);
  const auto corners = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    Corners t{first[a], first[b], first[c]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  std::vector<Corners> theirs, mine;
  for (auto face = peer.finite_faces_begin(); face != peer.finite_faces_end(); ++face) {
    theirs.push_back(
        corners(face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()));
  }
  const TriangleView triangles = ours.triangles.view();
  for (Index t = 0; t < triangles.rows(); ++t) {
    mine.push_back(corners(triangles(t, 0), triangles(t, 1), triangles(t, 2)));
  }
  std::sort(theirs.begin(), theirs.end());
  std::sort(mine.begin(), mine.end());
  return theirs == mine;
}

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double status_megabytes(const char* field) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(field, 0) == 0) return std::atof(line.c_str() + std::string(field).size()) / 1e3;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Peak resident memory above what the process had before, in a child of its own [MB].
double peak_megabytes(const std::function<void()>& work) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return std::numeric_limits<double>::quiet_NaN();
  malloc_trim(0);
  const pid_t child = fork();
  if (child == 0) {
    const double before = status_megabytes("VmRSS:");
    work();
    const double peak = status_megabytes("VmHWM:") - before;
    _exit(write(ends[1], &peak, sizeof peak) == sizeof peak ? 0 : 1);
  }
  close(ends[1]);
  double peak = std::numeric_limits<double>::quiet_NaN();
  if (read(ends[0], &peak, sizeof peak) != sizeof peak) peak = -1.0;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return peak;
}

void compare(const char* name, const PointMatrix& matrix, int rounds) {
  const PointView points(matrix.data(), matrix.rows(), 3);
  const auto peer = peer_points(points);
  const Delaunay whole =
      delaunay(points, {.max_edge = std::numeric_limits<double>::infinity(), .num_threads = 1});
  if (!same_triangles(points, whole)) {
    std::printf("%s: the triangles differ from CGAL's\n", name);
    std::exit(1);
  }
  const auto ours = [&](int num_threads) { delaunay(points, {.num_threads = num_threads}); };
  const auto theirs = [&] { Peer(peer.begin(), peer.end()); };
  const std::array<double, 3> memory{peak_megabytes([&] { ours(1); }),
                                     peak_megabytes([&] { ours(2); }), peak_megabytes(theirs)};
  std::vector<double> one, two, cgal, ratio_one, ratio_two;
  for (int round = 0; round < rounds; ++round) {
    one.push_back(seconds([&] { ours(1); }));
    cgal.push_back(seconds(theirs));
    two.push_back(seconds([&] { ours(2); }));
    ratio_one.push_back(one.back() / cgal.back());
    ratio_two.push_back(two.back() / cgal.back());
  }
  for (const auto& [threads, ratio, own, peak] :
       {std::tuple{1, median(ratio_one), median(one), memory[0]},
        std::tuple{2, median(ratio_two), median(two), memory[1]}}) {
    std::printf("| %s | %td | %d | %.2f | %.3f | %.3f | %.0f | %.0f |\n", name, points.rows(),
                threads, ratio, own, median(cgal), peak, memory[2]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 7;
  std::printf("## 2.5-D Delaunay triangulation against CGAL %s\n\n", CGAL_VERSION_STR);
  std::printf(
      "`build/bench/benchmarks/cpp/bench_delaunay %d`: medians of %d interleaved rounds; the sets "
      "of "
      "triangles are equal to CGAL's, to the last one. Ours is the whole call, from an (N, 3) "
      "array to "
      "ordered, trimmed triangles; CGAL's `Delaunay_triangulation_2` (EPICK, insertion of a range) "
      "is "
      "timed on one thread, the only way it runs. Memory is the peak above the input.\n\n",
      rounds, rounds);
  std::printf(
      "| soundings | points | threads | time / CGAL | ours [s] | CGAL [s] | ours [MB] | CGAL [MB] "
      "|\n"
      "|---|---|---|---|---|---|---|---|\n");
  compare("uniform", uniform_soundings(1000000), rounds);
  compare("UTM grid", utm_grid(1078, 1074), rounds);
  compare("survey lines", survey_lines(2500), rounds);
}
