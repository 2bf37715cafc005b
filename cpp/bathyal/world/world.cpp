// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/world.hpp"

#include <algorithm>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/world/materials.hpp"

namespace bathyal {

/// What does not change until something is added.
struct World::Built {
  Scene scene;  ///< at the time at which it was first asked for
  std::vector<SurfaceMaterial> surfaces;
};

namespace {

constexpr std::size_t kMostMaterials = 32767;  // numbered by 16 bits where painted

std::string quoted(const std::string& text) {
  std::string result = "\"";
  return result.append(text).append("\"");
}

std::string numbered(std::string name, std::size_t number) {
  return name.append("_").append(std::to_string(number));
}

std::vector<Pose> poses_at(const std::vector<WorldObject>& objects, double time) {
  std::vector<Pose> poses;
  poses.reserve(objects.size());
  for (const WorldObject& object : objects) poses.push_back(object.pose.at(time));
  return poses;
}

/// By the rule of even and odd crossings.
bool contains(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& point) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < x) inside = !inside;
  }
  return inside;
}

void check_surface(const WorldObject& object, std::size_t materials) {
  const auto check_row = [&](std::int32_t row) {
    if (row >= 0 && static_cast<std::size_t>(row) < materials) return;
    throw_argument("surface", "rows of the " + std::to_string(materials) + " materials",
                   std::to_string(row));
  };
  check_row(object.surface.whole);
  if (!object.surface.of_triangle) return;
  const std::vector<std::int16_t>& painted = *object.surface.of_triangle;
  if (painted.size() != static_cast<std::size_t>(object.mesh.triangle_count())) {
    throw_argument("surface", "a material for each of its triangles",
                   std::to_string(painted.size()));
  }
  for (const std::int16_t row : painted) check_row(row);
}

bool at_identity(const WorldObject& object) {
  return !object.pose.moves() && object.scale == 1.0 &&
         object.pose.at(0.0).matrix() == Pose::Identity().matrix();
}

Scene scene_of(const std::vector<WorldObject>& objects, std::vector<Pose> poses, int num_threads) {
  std::vector<TriangleMesh> meshes;
  std::vector<double> scales;
  for (const WorldObject& object : objects) {
    meshes.push_back(object.mesh);
    scales.push_back(object.scale);
  }
  // Where everything is as its mesh says, one hierarchy over all of it is the fastest.
  if (std::all_of(objects.begin(), objects.end(), at_identity)) {
    return Scene(std::move(meshes), num_threads);
  }
  return Scene(std::move(meshes), std::move(poses), scales, num_threads);
}

}  // namespace

World::World() : materials_(std::make_shared<const std::vector<Material>>(material_library())) {}

World::World(const World& other)
    : objects_(other.objects_),
      rows_(other.rows_),
      materials_(other.materials_),
      water_(other.water_) {}

World& World::operator=(const World& other) {
  if (this == &other) return *this;
  objects_ = other.objects_;
  rows_ = other.rows_;
  materials_ = other.materials_;
  water_ = other.water_;
  built_.reset();
  return *this;
}

World::~World() = default;

Index World::add(TriangleMesh mesh, Motion pose, const std::string& material, std::string name,
                 double scale) {
  const std::int32_t row = material_row(material);
  if (name.empty()) name = "object_" + std::to_string(objects_.size());
  return add(WorldObject{std::move(name), std::move(mesh), std::move(pose), scale, {row, nullptr}});
}

Index World::add(WorldObject object) {
  check_positive("scale", object.scale);
  if (object.name.empty()) throw_argument("name", "a name", "none");
  if (rows_.count(object.name) != 0) {
    throw_argument("name", "a name that is not taken", quoted(object.name));
  }
  check_surface(object, materials_->size());
  const auto at = static_cast<Index>(objects_.size());
  rows_.emplace(object.name, at);
  object.mesh = object.mesh.snapshot();
  objects_.push_back(std::move(object));
  built_.reset();
  return at;
}

Index World::add_clones(const TriangleMesh& mesh, std::int64_t count, const std::string& material,
                        const std::string& name, const CloneOptions& options) {
  const TriangleMesh shared = mesh.snapshot();
  const auto first = static_cast<Index>(objects_.size());
  const std::vector<ClonePlace> places = clone_places(shared, count, at(0.0).scene, options);
  material_row(material);
  for (std::size_t i = 0; i < places.size(); ++i) {  // all of them, or none
    const std::string one = numbered(name, i);
    if (rows_.count(one) != 0) throw_argument("name", "a name that is not taken", quoted(one));
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    add(shared, places[i].world_from_object, material, numbered(name, i), places[i].scale);
  }
  return first;
}

Index World::paint(const std::string& object, const std::vector<Eigen::Vector2d>& polygon,
                   const std::string& material) {
  if (polygon.size() < 3) {
    throw_argument("polygon", "three corners or more", std::to_string(polygon.size()));
  }
  for (const Eigen::Vector2d& corner : polygon) {
    check_finite("polygon", corner.x());
    check_finite("polygon", corner.y());
  }
  WorldObject& painted = objects_[static_cast<std::size_t>(row_of(object))];
  const auto colour = static_cast<std::int16_t>(material_row(material));
  const auto triangles = static_cast<std::size_t>(painted.mesh.triangle_count());
  auto materials = painted.surface.of_triangle
                       ? std::make_shared<std::vector<std::int16_t>>(*painted.surface.of_triangle)
                       : std::make_shared<std::vector<std::int16_t>>(
                             triangles, static_cast<std::int16_t>(painted.surface.whole));
  const Pose pose = painted.pose.at(0.0);
  Index count = 0;
  for (std::size_t i = 0; i < triangles; ++i) {
    const auto row = static_cast<Index>(i);
    const Vec3 sum =
        painted.mesh.corner(row, 0) + painted.mesh.corner(row, 1) + painted.mesh.corner(row, 2);
    const Vec3 middle = pose * Vec3(painted.scale / 3.0 * sum);
    if (!contains(polygon, middle.head<2>())) continue;
    (*materials)[i] = colour;
    ++count;
  }
  painted.surface.of_triangle = std::move(materials);
  built_.reset();
  return count;
}

void World::set_material(Material material) {
  material.check();
  auto materials = std::make_shared<std::vector<Material>>(*materials_);
  const auto found = std::find_if(materials->begin(), materials->end(),
                                  [&](const Material& m) { return m.name == material.name; });
  if (found == materials->end()) {
    if (materials->size() == kMostMaterials) {
      throw_argument("material", "at most 32767 of them", "one more");
    }
    materials->push_back(std::move(material));
  } else {
    *found = std::move(material);
  }
  materials_ = std::move(materials);
}

std::int32_t World::material_row(const std::string& name) const {
  for (std::size_t i = 0; i < materials_->size(); ++i) {
    if ((*materials_)[i].name == name) return static_cast<std::int32_t>(i);
  }
  std::string known;
  for (const Material& material : *materials_) {
    known.append(known.empty() ? "" : ", ").append(material.name);
  }
  throw_argument("material", known.insert(0, "one of "), quoted(name));
}

Index World::row_of(const std::string& name) const {
  const auto found = rows_.find(name);
  if (found != rows_.end()) return found->second;
  throw_argument("object", "the name of an object", quoted(name));
}

bool World::moves() const {
  return std::any_of(objects_.begin(), objects_.end(),
                     [](const WorldObject& object) { return object.pose.moves(); });
}

std::shared_ptr<const World::Built> World::built(const std::vector<Pose>& poses,
                                                 int num_threads) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!built_) {
    std::vector<SurfaceMaterial> surfaces;
    for (const WorldObject& object : objects_) surfaces.push_back(object.surface);
    built_ = std::make_shared<const Built>(
        Built{scene_of(objects_, poses.empty() ? poses_at(objects_, 0.0) : poses, num_threads),
              std::move(surfaces)});
  }
  return built_;
}

WorldSnapshot World::at(double time, int num_threads) const {
  check_finite("time", time);
  if (objects_.empty()) throw_argument("world", "one object or more", "none");
  if (!moves()) {
    const std::shared_ptr<const Built> still = built({}, num_threads);
    return {still->scene, still->surfaces, materials_, time};
  }
  // Outside of the lock: a function of time may itself ask this world.
  const std::vector<Pose> poses = poses_at(objects_, time);
  const std::shared_ptr<const Built> now = built(poses, num_threads);
  const Scene scene = now->scene.with_poses(poses, num_threads);
  return {scene, now->surfaces, materials_, time};
}

}  // namespace bathyal
