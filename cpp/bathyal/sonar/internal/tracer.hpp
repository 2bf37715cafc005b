// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "bathyal/sonar/internal/bent_paths.hpp"
#include "bathyal/sonar/internal/echo_rows.hpp"
#include "bathyal/sonar/internal/facets.hpp"
#include "bathyal/sonar/internal/ray_fan.hpp"
#include "bathyal/sonar/internal/reception.hpp"
#include "bathyal/sonar/internal/scatter_tables.hpp"
#include "bathyal/sonar/vehicle_motion.hpp"
#include "bathyal/world/snapshot.hpp"

namespace bathyal::sonar {

/// In place of a mesh and of a material: the sea surface.
inline constexpr std::int32_t kSurface = -2;

/// What a ping takes place in.
struct Setting {
  const SonarOptions& options;
  const WorldSnapshot& world;
  const ScatterTables& tables;
  Pose world_from_head = Pose::Identity();
  double sound_speed = 1500.0;         ///< at the sonar [m/s]
  double sonar_depth = 0.0;            ///< [m]
  std::optional<double> surface = {};  ///< z of the flat sea surface [m]
  const BentPaths* bent = nullptr;     ///< null: sound runs straight
  VehicleMotion motion = {};           ///< of the head
};

/// Columns of one beam that are traced as one.
struct Task {
  std::size_t beam;
  std::size_t first_column, last_column;
};

std::vector<Task> tasks_of(const std::vector<BeamRays>& fans);

/// A place that a ray has come to.
struct Arrival {
  double range = std::numeric_limits<double>::infinity();  ///< by time: c₀ t [m]
  double length = 0.0;  ///< by which it has spread: R² is the area of a unit solid angle [m]
  RayHit hit = {};      ///< what is there; .mesh is kSurface for the sea surface, −1 for nothing
  Vec3 point = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();  ///< of the ray there
  Vec3 normal = Vec3::Zero();      ///< of what is there, unit
  Vec3 by_psi = Vec3::Zero();  ///< how the ray's direction changes with ψ, as if nothing bent it
  Vec3 by_phi = Vec3::Zero();
};

struct Traveller;

/// The triangle that was met last, and its normal: neighbouring rays often meet the same.
struct Facet {
  std::int32_t mesh = -1, triangle = -1;
  Vec3 normal = Vec3::Zero();
};

/// Traces the rays of a ping.
class Tracer {
 public:
  explicit Tracer(const Setting& setting);

  EchoPart trace(const BeamRays& fan, const Task& task) const;

 private:
  struct Batch;  ///< what a thread works with, batch.hpp

  void launch(const BeamRays& fan, Batch& batch) const;
  void arrive_straight(Batch& batch) const;
  void arrive_bent(Batch& batch) const;
  void arrive_on_chord(Batch& batch, const Traveller& traveller, std::size_t chord,
                       const Vec3& on_chord, const RayHit& hit) const;
  void follow_reflections(const BeamRays& fan, Batch& batch) const;
  bool reflect(Arrival& arrival, double& power) const;

  void tangents(const BeamRays& fan, const Vec3& launch, Arrival& arrival) const;
  Return returned(const BeamRays& fan, const Arrival& arrival, double weight) const;
  void spread(const BeamRays& fan, const Arrival& arrival, double against, Return& back) const;
  double received(const Reception& reception, const Vec3& launch, Return& back) const;
  double weight(const BeamRays& fan, std::size_t ray) const;
  Vec3 normal(const RayHit& hit, Facet& last) const;
  double power(double scattered, double length) const;
  bool meets_surface(const Vec3& from, const Vec3& direction, RayHit& hit) const;

  const Setting& setting_;
  const SonarOptions& options_;
  Facets facets_;
  bool moves_;
};

}  // namespace bathyal::sonar
