// SPDX-License-Identifier: BSD-3-Clause
// Products of tall matrices, of which diagnosis is made, against Eigen's own as the rest of bathyal
// is built (SSE2): a library built for no particular machine has no wider ones. Results agree to
// rounding, and ours are the same bytes at every level, before any time is printed.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/base/simd.hpp"
#include "bathyal/estimation/gram.hpp"
#include "timing.hpp"

namespace {

using namespace bathyal;
using Eigen::Index;
using Eigen::MatrixXd;

struct Shape {
  const char* what;
  Index rows, one, other;
};

MatrixXd drawn(Index rows, Index columns, std::uint64_t seed) {
  RandomStream random(seed);
  MatrixXd out(rows, columns);
  for (double& value : out.reshaped()) value = random.uniform(-1.0, 1.0);
  return out;
}

[[noreturn]] void differ(const std::string& what) {
  std::printf("%s differs from Eigen's product, or from level to level\n", what.c_str());
  std::exit(1);
}

/// `ours` and `eigens` fill the matrix they are given.
template <class Ours, class Eigens>
void compare(const std::string& what, double operations, int rounds, const Ours& ours,
             const Eigens& eigens) {
  const std::vector<SimdLevel> levels = available_simd_levels();
  MatrixXd theirs, first, now;
  eigens(theirs);
  for (const SimdLevel level : levels) {
    set_simd_level(level);
    ours(now);
    if (first.size() == 0) first = now;
    if (now != first || !now.isApprox(theirs, 1e-12)) differ(what);
  }
  std::vector<double> eigen_seconds;
  std::vector<std::vector<double>> own_seconds(levels.size()), ratios(levels.size());
  for (int round = 0; round < rounds; ++round) {
    eigen_seconds.push_back(thread_seconds([&] { eigens(theirs); }));
    for (std::size_t l = 0; l < levels.size(); ++l) {
      set_simd_level(levels[l]);
      own_seconds[l].push_back(thread_seconds([&] { ours(now); }));
      ratios[l].push_back(eigen_seconds.back() / own_seconds[l].back());
    }
  }
  for (std::size_t l = 0; l < levels.size(); ++l) {
    std::printf("| %s | %s | **%.1f ×** | %.0f | %.0f |\n", what.c_str(),
                std::string(to_text(levels[l])).c_str(), median(ratios[l]),
                1e-9 * operations / median(own_seconds[l]),
                1e-9 * operations / median(eigen_seconds));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 15;
  std::printf("## Products of tall matrices against Eigen %d.%d.%d\n\n", EIGEN_WORLD_VERSION,
              EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
  std::printf(
      "`build/bench/benchmarks/cpp/bench_products %d`: one thread, processor time, medians of %d "
      "interleaved rounds. Eigen as a library is built that knows no machine (SSE2); its own wider "
      "products need a build for one machine. Ours choose as they run, and give the same bytes at "
      "every level.\n\n"
      "| product | SIMD | Eigen / ours | ours [GFlop/s] | Eigen [GFlop/s] |\n"
      "|---|---|---|---|---|\n",
      rounds, rounds);
  for (const Shape& s : {Shape{"2,082 rows, 120 × 80", 2082, 120, 80},
                         Shape{"2,082 rows, 120 × 1,000", 2082, 120, 1000},
                         Shape{"35,733 rows, 130 × 64", 35733, 130, 64}}) {
    const MatrixXd a = drawn(s.rows, s.one, 1), b = drawn(s.rows, s.other, 2);
    const MatrixXd small = drawn(s.one, s.other, 3);
    const double operations = 2.0 * static_cast<double>(s.rows * s.one * s.other);
    compare(
        std::string("aᵀ b, ") + s.what, operations, rounds,
        [&](MatrixXd& out) { out = inner_products(a, b, 1); },
        [&](MatrixXd& out) { out.noalias() = a.transpose() * b; });
    compare(
        std::string("a c, ") + s.what, operations, rounds,
        [&](MatrixXd& out) { out = product(a, small, 1); },
        [&](MatrixXd& out) { out.noalias() = a * small; });
  }
}
