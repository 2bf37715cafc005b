// SPDX-License-Identifier: BSD-3-Clause
// Far side lobes of beams that one array forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bathyal/sonar/echo.hpp"
#include "bathyal/sonar/presets.hpp"
#include "worlds.hpp"

namespace bathyal {
namespace {

using test::at;
using test::flat;
using test::world_of;

SonarOptions multibeam(bool side_lobes) {
  SonarOptions options = multibeam_sonar();
  options.beams = 121;
  options.sector = std::numbers::pi * 120 / 180;
  options.beam_width = std::numbers::pi / 180;
  options.beam_pattern = BeamPattern::kUniform;
  options.range = 60.0;
  options.samples = 600;
  options.rays_across_beam = 60;
  options.side_lobes = side_lobes;
  return options;
}

double row_sum(const Echo& echo, Index beam) {
  const auto begin = echo.power.begin() + static_cast<std::ptrdiff_t>(beam * echo.samples);
  double total = 0.0;
  for (auto p = begin; p != begin + echo.samples; ++p) total += *p;
  return total;
}

/// A small plate 20 m below, across the middle beam.
Echo plate_below(bool side_lobes) {
  const WorldSnapshot plate =
      world_of({test::mesh_of({{-1, -0.05, -20}, {1, -0.05, -20}, {1, 0.05, -20}, {-1, 0.05, -20}},
                              {{0, 1, 2}, {0, 2, 3}})},
               {1.0});
  return Sonar(multibeam(side_lobes)).echo(plate, Water(), at(0, 0, 0));
}

TEST(SideLobes, APointTargetIsHeardByTheMeanOfTheLobes) {
  const Echo echo = plate_below(true), without = plate_below(false);
  const double main = row_sum(echo, 60);
  EXPECT_DOUBLE_EQ(main, row_sum(without, 60));
  for (const Index off : {8, 15, 30, 50}) {
    // sinc² of x, half a width at 1.3916, its mean over lobes 1 / (2 x²), its array coordinate
    // sines
    const double steered = static_cast<double>(off) * std::numbers::pi / 180;
    const double x =
        1.3915573782515103 * std::sin(steered) / std::sin(0.5 * std::numbers::pi / 180);
    const double expected = 10 * std::log10(0.5 / (x * x));
    for (const Index beam : {60 - off, 60 + off}) {
      EXPECT_EQ(row_sum(without, beam), 0.0);
      EXPECT_NEAR(10 * std::log10(row_sum(echo, beam) / main), expected, 1.5) << beam;
    }
  }
}

TEST(SideLobes, TheNadirRingsInAllBeams) {
  const WorldSnapshot bottom = world_of({flat(0.0)}, {1.0});
  const auto ring = [&](bool side_lobes) {
    const Echo echo = Sonar(multibeam(side_lobes)).echo(bottom, Water(), at(0, 0, 20));
    // the outermost beam meets the bottom at 40 m; at 20 m it hears the nadir
    const auto from = echo.power.begin();
    return std::pair(*std::max_element(from + 195, from + 210),
                     *std::max_element(from, from + 600));
  };
  EXPECT_EQ(ring(false).first, 0.0);
  const auto [at_nadir, at_bottom] = ring(true);
  EXPECT_GT(at_nadir, 0.0);
  EXPECT_LT(at_nadir, 0.1 * at_bottom);
}

TEST(SideLobes, TheSameBytesOnAnyNumberOfThreads) {
  const WorldSnapshot bottom = world_of({flat(0.0)}, {1.0});
  const Sonar sonar(multibeam(true));
  EXPECT_EQ(sonar.echo(bottom, Water(), at(0, 0, 20), 0, 1).power,
            sonar.echo(bottom, Water(), at(0, 0, 20), 0, 3).power);
}

TEST(SideLobes, NoneWithoutAPatternOrNeighbours) {
  const WorldSnapshot bottom = world_of({flat(0.0)}, {1.0});
  SonarOptions box = multibeam(true), plain = multibeam(false);
  box.beam_pattern = plain.beam_pattern = BeamPattern::kNone;
  EXPECT_EQ(Sonar(box).echo(bottom, Water(), at(0, 0, 20)).power,
            Sonar(plain).echo(bottom, Water(), at(0, 0, 20)).power);
  SonarOptions side = side_scan_sonar(), other = side;
  side.side_lobes = true;
  side.beam_pattern = other.beam_pattern = BeamPattern::kUniform;
  EXPECT_EQ(Sonar(side).echo(bottom, Water(), at(0, 0, 20)).power,
            Sonar(other).echo(bottom, Water(), at(0, 0, 20)).power);
}

}  // namespace
}  // namespace bathyal
