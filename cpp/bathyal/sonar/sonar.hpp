// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bathyal/geometry/pose.hpp"
#include "bathyal/sonar/receiver.hpp"
#include "bathyal/water/absorption.hpp"

namespace bathyal {

enum class SonarKind { kEchoSounder, kSideScan, kMultibeam, kImaging, kScanning };

/// How a beam's fan is covered by rays.
enum class RayModel {
  kAngles,  ///< equal angles, each with the solid angle that it covers
  kCamera,  ///< pixels of an ideal camera that count equally (Bobkov and others 2014)
};

/// One-way power by angle, half of it half a width off the axis.
enum class BeamPattern {
  kNone,     ///< the same in all of beam_width and fan_span, nothing outside
  kUniform,  ///< of a uniform line array: sinc², side lobes at −13.3 dB
  kHann,     ///< of one under a Hann window, −31.5 dB
  kTaylor,   ///< under Taylor's window of four nearly even lobes, −30 dB
  kGaussian,
};

/// By which law a surface scatters sound back.
enum class BackscatterModel {
  kLambert,   ///< strength · cos²θ
  kMaterial,  ///< the material's table or sediment where it has one, else Lambert
};

/// The description of a sonar. A beam is made narrow by a line array: φ is the angle from the plane
/// across the array, ψ turns about it, from the beam's axis. Of a side-scan the array lies along x
/// (φ along track, ψ from the bottom to the horizon); of a multibeam, imaging or scanning sonar
/// along y (φ across, ψ in the plane of x and z). Every physical effect is a switch, and off;
/// those of the receiver come first.
struct SonarOptions : ReceiverOptions {
  SonarKind kind = SonarKind::kSideScan;
  std::string name = "side_scan";

  // Signal.
  double frequency = 600e3;     ///< [Hz], 1 kHz to 10 MHz
  double pulse_length = 50e-6;  ///< [s], above 0
  double bandwidth = 20e3;      ///< [Hz], above 0
  double source_level = 210.0;  ///< [dB re 1 µPa at 1 m]
  double ping_rate = 10.0;      ///< [Hz], above 0

  // Samples: sample i is the power from [iΔ, (i + 1)Δ), Δ = range / samples.
  double range = 75.0;  ///< slant range of the end of the last sample [m], above 0
  int samples = 1500;   ///< 1 to 10⁶

  // Beams.
  int beams = 2;                         ///< 1 to 4096; of a side-scan 1 (port) or 2
  double sector = 0.0;                   ///< between the axes of the outer beams [rad], 0 to π
  double beam_width = 0.0105;            ///< in φ [rad], above 0, to π/2
  double fan_width = 0.87;               ///< in ψ [rad], above 0, to π
  double fan_span = 1.5707963267948966;  ///< of ψ that rays cover [rad], above 0, to π
  double tilt =
      0.7853981633974483;  ///< of the fan's middle below the horizontal [rad], −π/2 to π/2
  double axis_tilt = 0.7853981633974483;  ///< of the beam's axis, where its pattern counts [rad]
  double head_start = 0.0;                ///< of a scanning head at ping 0, to port [rad]
  double head_step = 0.0;                 ///< and from ping to ping [rad]
  Pose vehicle_from_sonar = Pose::Identity();

  // Rays of each beam.
  RayModel rays = RayModel::kAngles;
  int rays_across_beam = 8;   ///< over φ, 1 to 10⁵
  int rays_along_fan = 2000;  ///< over ψ, 1 to 10⁶

  // Switches.
  bool spreading = false;                       ///< two-way, R⁻⁴ of what an area scatters
  std::optional<AbsorptionFormula> absorption;  ///< by the water at the sonar's depth
  BackscatterModel backscatter = BackscatterModel::kLambert;
  BeamPattern beam_pattern = BeamPattern::kNone;
  bool pixel_solid_angle =
      false;                ///< pixels count by their solid angle, cos³ of the angle off axis
  bool refraction = false;  ///< by the water's profile: sound runs along arcs
  int multiples = 0;        ///< reflections after which a ray is still followed, 0 to 8; with a
                            ///< surface, that one reflects and scatters as well
  double wind_speed = 5.0;  ///< at 10 m, by which the sea surface scatters [m/s], 0 to 50
  bool motion = false;      ///< of the vehicle, between transmission and reception
  bool side_lobes = false;  ///< each beam of a multibeam or an imaging sonar hears the far side
                            ///< lobes of its pattern: what comes from all other beams' sectors
  bool layover = true;      ///< what is nearer than a lower part of its fan is heard as well

  /// \throw std::invalid_argument that names the field.
  void check() const;

  double sample_length() const { return range / samples; }  ///< [m]
  double wavelength(double sound_speed) const { return sound_speed / frequency; }
};

/// A beam: unit vectors of its frame in the sonar's, and its name. u(φ, ψ) = sin φ · array +
/// cos φ (cos ψ · axis + sin ψ · up), ψ from the middle of the fan.
struct Beam {
  std::string name;
  Vec3 array = Vec3::UnitX();
  Vec3 axis = Vec3::UnitY();  ///< of the middle of the fan at φ = 0
  double sense = 1.0;         ///< up is sense · (array × axis): to where ψ rises
  double steered = 0.0;       ///< φ of its middle [rad]

  Vec3 up() const { return sense * array.cross(axis); }
  Vec3 direction(double phi, double psi) const {
    return std::sin(phi) * array + std::cos(phi) * (std::cos(psi) * axis + std::sin(psi) * up());
  }
};

/// The beams of a sonar, in the order of its rows, a scanning head straight ahead.
std::vector<Beam> beams_of(const SonarOptions& options);

/// sonar_from_head of a scanning head at a ping; the identity of all others.
Pose head_pose(const SonarOptions& options, std::int64_t ping);

std::string to_string(SonarKind kind);

}  // namespace bathyal
