// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "bathyal/water/water.hpp"
#include "bathyal/world/clones.hpp"
#include "bathyal/world/motion.hpp"
#include "bathyal/world/snapshot.hpp"

namespace bathyal {

/// A thing of a world, or one of its clones.
struct WorldObject {
  std::string name;
  TriangleMesh mesh;  ///< in its own frame; clones share it
  Motion pose;        ///< world_from_object
  double scale = 1.0;
  SurfaceMaterial surface;
};

/// Seabed, things on it and in the water, what they are made of, and the water. Objects are rows of
/// what rays see, in the order in which they were added. One thread changes a world; any number may
/// ask it while none does.
class World {
 public:
  /// Empty, with the materials of material_library() and uniform water.
  World();
  World(const World& other);
  World& operator=(const World& other);
  ~World();

  /// Adds an object, and returns its row.
  /// \throw std::invalid_argument for a name that is taken, a material that is not known, a scale
  ///        that is not above 0.
  Index add(TriangleMesh mesh, Motion pose = {}, const std::string& material = "sand",
            std::string name = {}, double scale = 1.0);

  /// Adds an object with the materials that its surface names by their rows.
  /// \throw std::invalid_argument for an empty name or one that is taken, a row of no material,
  ///        another count of triangles, a scale that is not above 0.
  Index add(WorldObject object);

  /// Scatters copies of a mesh over what is there at time 0: rows that share the mesh, named
  /// name_0, name_1 …; all of them, or after an error none.
  /// \return The first of their rows.
  /// \throw std::invalid_argument as add and clone_places.
  Index add_clones(const TriangleMesh& mesh, std::int64_t count, const std::string& material,
                   const std::string& name, const CloneOptions& options = {});

  /// Gives those triangles of an object another material whose middle lies within a polygon, seen
  /// from above at time 0. \param polygon (K, 2), K ≥ 3, in the world [m]
  /// \return How many.
  Index paint(const std::string& object, const std::vector<Eigen::Vector2d>& polygon,
              const std::string& material);

  /// Adds a material, or replaces the one of that name.
  void set_material(Material material);

  const std::vector<WorldObject>& objects() const { return objects_; }
  const std::vector<Material>& materials() const { return *materials_; }
  std::int32_t material_row(const std::string& name) const;  ///< \throw for an unknown name
  Index row_of(const std::string& name) const;               ///< \throw for an unknown name

  const Water& water() const { return water_; }
  void set_water(Water water) { water_ = std::move(water); }

  /// Whether anything moves.
  bool moves() const;

  /// What there is at a time [s]. Meshes and their hierarchies are shared from moment to moment;
  /// while nothing is added, only the tree over the objects is made anew, and in a world at rest
  /// not even that.
  /// \throw std::invalid_argument for a world without objects, a time that is not finite, a
  ///        function whose pose is not rigid.
  WorldSnapshot at(double time = 0.0, int num_threads = 0) const;

 private:
  struct Built;
  /// \param poses At which it is built where it is not yet; empty for a world at rest.
  std::shared_ptr<const Built> built(const std::vector<Pose>& poses, int num_threads) const;

  std::vector<WorldObject> objects_;
  std::unordered_map<std::string, Index> rows_;  ///< by name
  std::shared_ptr<const std::vector<Material>> materials_;
  Water water_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const Built> built_;  ///< null after a change
};

}  // namespace bathyal
