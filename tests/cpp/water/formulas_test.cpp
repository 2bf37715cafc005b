// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bathyal/water/absorption.hpp"
#include "bathyal/water/seawater.hpp"
#include "bathyal/water/sound_speed.hpp"

namespace bathyal {
namespace {

TEST(SoundSpeed, CheckValuesAsPrinted) {
  EXPECT_NEAR(sound_speed(SoundSpeedFormula::kMackenzie, 25, 35, {.depth = 1000}), 1550.744, 5e-4);
  EXPECT_NEAR(sound_speed(SoundSpeedFormula::kChenMillero, 40, 40, {.pressure = 10000}), 1731.995,
              5e-4);
  // UNESCO 44, table of sound speeds: 0 °C, 35, 0 dbar, and 10 °C, 30, 5 000 dbar.
  EXPECT_NEAR(sound_speed(SoundSpeedFormula::kChenMillero, 0, 35, {.pressure = 0}), 1449.1, 0.05);
}

// The coefficients as Wong and Zhu (1995) revised them for ITS-90: other numbers, the same speed.
double del_grosso_its90(double t, double s, double p) {
  return 1402.392 + t * (0.5012285e1 + t * (-0.551184e-1 + t * 0.221649e-3)) +
         s * (0.1329530e1 + s * 0.1288598e-3) +
         p * (0.1560592 + p * (0.2449993e-4 - p * 0.8833959e-8)) - 0.1275936e-1 * t * s +
         0.6353509e-2 * t * p + 0.2656174e-7 * t * t * p * p - 0.1593895e-5 * t * p * p +
         0.5222483e-9 * t * p * p * p - 0.4383615e-6 * t * t * t * p -
         0.1616745e-8 * s * s * p * p + 0.9688441e-4 * t * t * s + 0.4857614e-5 * t * s * s * p -
         0.3406824e-3 * t * s * p;
}

TEST(SoundSpeed, DelGrossoIsWhatWongAndZhuRevised) {
  for (const double t : {0.0, 4.0, 15.0, 28.0}) {
    for (const double s : {31.0, 35.0, 39.0}) {
      for (const double dbar : {0.0, 500.0, 5000.0}) {
        EXPECT_NEAR(sound_speed(SoundSpeedFormula::kDelGrosso, ipts68(t), s, {.pressure = dbar}),
                    del_grosso_its90(t, s, dbar / 9.80665), 0.003);
      }
    }
  }
}

TEST(SoundSpeed, FormulasAgreeInTheOcean) {
  const double latitude = 0.7;
  for (const double t : {3.0, 10.0, 20.0}) {
    for (const double depth : {0.0, 200.0, 1500.0}) {
      const SoundSpeedPlace place{depth, pressure_from_depth(depth, latitude)};
      const double m = sound_speed(SoundSpeedFormula::kMackenzie, t, 35, place);
      EXPECT_NEAR(sound_speed(SoundSpeedFormula::kChenMillero, t, 35, place), m, 0.7);
      EXPECT_NEAR(sound_speed(SoundSpeedFormula::kDelGrosso, t, 35, place), m, 0.3);
    }
  }
}

TEST(SoundSpeed, NamesWhatIsOutside) {
  EXPECT_EQ(outside_sound_speed(SoundSpeedFormula::kMackenzie, 10, 35, {.depth = 50}), "");
  EXPECT_EQ(outside_sound_speed(SoundSpeedFormula::kMackenzie, 1, 20, {.depth = 9000}),
            "temperature 1 °C (2 to 30), salinity 20 (25 to 40), depth 9000 m (0 to 8000)");
  EXPECT_EQ(outside_sound_speed(SoundSpeedFormula::kDelGrosso, 10, 12, {.pressure = 50}),
            "salinity 12 (30 to 40)");
  EXPECT_THROW(check_seawater(NAN, 35), std::invalid_argument);
  EXPECT_THROW(check_seawater(10, -1), std::invalid_argument);
}

TEST(Absorption, IssuesTable) {
  const double fg[] = {33.4, 158.6, 298.6};
  const double am[] = {34.1, 168.9, 321.1};
  const double hertz[] = {100e3, 600e3, 900e3};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(absorption(AbsorptionFormula::kFrancoisGarrison, hertz[i], {}), fg[i],
                0.002 * fg[i]);
    EXPECT_NEAR(absorption(AbsorptionFormula::kAinslieMcColm, hertz[i], {}), am[i], 0.002 * am[i]);
  }
}

TEST(Absorption, TheTwoAgreeWithinTheirAccuracy) {
  for (const double t : {0.0, 5.0, 15.0, 21.0}) {
    for (const double f : {1e3, 10e3, 60e3, 300e3, 490e3}) {
      const AbsorptionPlace place{.temperature = t, .salinity = 34, .depth = 400};
      const double a = absorption(AbsorptionFormula::kFrancoisGarrison, f, place);
      EXPECT_NEAR(absorption(AbsorptionFormula::kAinslieMcColm, f, place), a, 0.15 * a) << t << f;
    }
  }
}

TEST(Absorption, ContinuousWhereTheWaterTermChanges) {
  AbsorptionPlace at{.temperature = 20.0};
  const double low = absorption(AbsorptionFormula::kFrancoisGarrison, 1e6, at);
  at.temperature = 20.0 + 1e-9;
  EXPECT_NEAR(absorption(AbsorptionFormula::kFrancoisGarrison, 1e6, at), low, 2e-3 * low);
}

TEST(Absorption, RangeAndRefusals) {
  EXPECT_EQ(outside_absorption(AbsorptionFormula::kFrancoisGarrison, 100e3, {}), "");
  EXPECT_NE(outside_absorption(AbsorptionFormula::kFrancoisGarrison, 100e3, {.salinity = 5}), "");
  EXPECT_EQ(outside_absorption(AbsorptionFormula::kFrancoisGarrison, 900e3, {.salinity = 5}), "");
  EXPECT_NE(outside_absorption(AbsorptionFormula::kAinslieMcColm, 2e6, {}), "");
  EXPECT_THROW(check_absorption(0.0, {}), std::invalid_argument);
  EXPECT_THROW(check_absorption(NAN, {}), std::invalid_argument);
  EXPECT_THROW(check_absorption(1e5, {.ph = 14}), std::invalid_argument);
  // 20 dB are a factor of 10 in amplitude, ln 10 nepers.
  EXPECT_NEAR(nepers_per_metre(20.0e3), std::numbers::ln10, 1e-12);
}

TEST(Seawater, Eos80CheckValues) {
  // UNESCO (1981), table of check values; temperatures there are on IPTS-68, pressures in bar.
  EXPECT_NEAR(seawater_density(its90(5), 0, 0), 999.96675, 1e-5);
  EXPECT_NEAR(seawater_density(its90(5), 35, 0), 1027.67547, 1e-5);
  EXPECT_NEAR(seawater_density(its90(25), 35, 10000), 1062.53817, 1e-5);
  EXPECT_NEAR(seawater_density(its90(5), 35, 10000), 1069.48914, 1e-5);
}

TEST(Seawater, PracticalSalinityCheckValue) {
  // Fofonoff and Millard (1983): R = 1.888091 at 40 °C and 10 000 dbar.
  EXPECT_NEAR(practical_salinity(1.888091 * 4.2914, its90(40), 10000), 40.00000, 1e-5);
  EXPECT_NEAR(practical_salinity(4.2914, its90(15), 0), 35.0, 1e-6);
  EXPECT_EQ(practical_salinity(0.0, 10, 0), 0.0);
}

TEST(Seawater, DepthAndPressureAreInverse) {
  // gsw 3.6: z_from_p(1000, 45) and (10000, 30).
  for (const double latitude : {-1.5, 0.0, 0.5, 1.2}) {
    for (const double depth : {0.0, 0.5, 100.0, 5000.0, 11000.0}) {
      EXPECT_NEAR(depth_from_pressure(pressure_from_depth(depth, latitude), latitude), depth, 1e-9);
    }
  }
  // UNESCO 44: 9712.653 m at 10 000 dbar and 30°; TEOS-10 differs by a metre.
  EXPECT_NEAR(depth_from_pressure(10000, std::numbers::pi / 6), 9712.653, 2.0);
}

}  // namespace
}  // namespace bathyal
