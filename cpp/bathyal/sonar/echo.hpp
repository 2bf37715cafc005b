// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bathyal/sonar/sonar.hpp"
#include "bathyal/sonar/vehicle_motion.hpp"
#include "bathyal/water/water.hpp"
#include "bathyal/world/snapshot.hpp"

namespace bathyal {

/// Of each sample, the ray that contributed most; NaN and −1 where nothing was hit.
struct EchoTruth {
  std::vector<double> range;           ///< one-way from the sonar [m]
  std::vector<double> incidence;       ///< from the surface's normal [rad]
  std::vector<std::int32_t> material;  ///< row of the world's materials; −2 the sea surface
  std::vector<double> point;           ///< (…, 3) in the world [m]
};

/// What arrives at a sonar after one ping, before its receiver: (beams, samples), row by row.
struct Echo {
  Index beams = 0;
  Index samples = 0;
  std::vector<double> power;  ///< received over transmitted at 1 m
  EchoTruth truth;
  double sound_speed = 0.0;  ///< at the sonar, by which ranges are counted [m/s]
  double altitude = std::numeric_limits<double>::quiet_NaN();  ///< straight down; NaN: nothing [m]
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  ///< of what a result rests on, "extrapolated: …"
};

/// A sonar made ready: its rays are computed once. Immutable, cheap to copy; any number of threads
/// may use it.
///
/// A ray that meets a surface at range R under the angle θ from its normal brings
///
///   w = σ₀(θ) · b² · e^(−4αR) · ΔΩ / (R² cos θ),  α in Np/m,
///
/// where ΔΩ is its solid angle and b² the two-way beam pattern: an area dA = R² ΔΩ / cos θ scatters
/// σ₀ dA, and R⁻⁴ is the spreading there and back. Equal solid angles thus carry the cosine per
/// area and R⁻² by themselves. Without spreading R⁻⁴ is left out: w = σ₀ b² e^(−4αR) dA.
///
/// The power of a ray belongs to the ranges that its cell covers on the plane of what it met, R ±
/// ½ R |n·∂u/∂ψ| / |n·u| Δψ or as much by φ, and is spread over their samples; what lies beyond the
/// last sample is not heard. Ranges count by time: R = ½ c₀ t, with c₀ the sound speed at the
/// sonar. Where sound is bent, R² in w is the area that a tube of rays has spread to over its solid
/// angle (within 0.1 to 10 of the straight one's, near caustics); after reflections R is the whole
/// way, and w has |Γ|⁴ of each, there and back. What lies above a sea surface is not seen. With
/// RayModel::kCamera (Bobkov and others 2014) every pixel counts the same, I = K_d cos θ, and all
/// of it falls into one sample, E_s = Σ I; spreading divides by R².
class Sonar {
 public:
  /// \throw std::invalid_argument as SonarOptions::check, or for more than 3·10⁸ rays a ping.
  explicit Sonar(SonarOptions options = {});

  const SonarOptions& options() const;

  /// The echo of one ping. `ping` counts the pings of a scanning head. `motion` counts where
  /// SonarOptions::motion is on. Without `truth` that of the echo is empty. The same bytes for any
  /// number of threads. \throw std::invalid_argument for a pose that is not rigid, a sonar above
  /// the surface, below
  ///        the bottom or inside a body.
  Echo echo(const WorldSnapshot& world, const Water& water, const Pose& world_from_vehicle,
            std::int64_t ping = 0, int num_threads = 0, const VehicleMotion& motion = {},
            bool truth = true) const;

  /// Rays of a ping.
  std::int64_t ray_count() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace bathyal
