// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/scene/internal/instances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/scene/internal/wide_tree.hpp"

namespace bathyal {
namespace scene {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Rotation = Eigen::Map<const RowMajor3>;
using Position = Eigen::Map<const Vec3>;

constexpr std::size_t kInstanceGrain = 1024;  ///< instances of one task
constexpr double kLeastScale = 1e-9;          ///< keeps lengths in a mesh's frame far from limits
constexpr double kLargestScale = 1e9;

Rotation rotation_of(const InstanceFrame& frame) { return Rotation(&frame.rotation[0][0]); }
Position position_of(const InstanceFrame& frame) { return Position(frame.position); }

/// Largest distance of a triangle's corner from the middle of all triangles' box.
double radius_of(const Scene::Hierarchy& hierarchy, int num_threads) {
  struct Largest {
    double squared = 0.0;
    Largest& operator+=(const Largest& other) {
      squared = std::max(squared, other.squared);
      return *this;
    }
  };
  const Vec3 middle = hierarchy.origin + 0.5 * (hierarchy.low + hierarchy.high);
  constexpr std::size_t kGrain = 16384;
  const Largest largest = parallel_sum<Largest>(
      hierarchy.primitive_count, kGrain, num_threads, [&](std::size_t begin, std::size_t end) {
        Largest part;
        for (std::size_t i = begin; i < end; ++i) {
          for (const Vec3& corner : hierarchy.corners(static_cast<std::uint32_t>(i))) {
            part.squared = std::max(part.squared, (corner - middle).squaredNorm());
          }
        }
        return part;
      });
  return std::sqrt(largest.squared);
}

/// Largest deviation of rotationᵀ · rotation from the identity.
double skewness(const Eigen::Matrix3d& rotation, Eigen::Matrix3d& product) {
  product.noalias() = rotation.transpose() * rotation;
  return (product - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

/// The pose's rotation itself where it is one to a few digits of double's last, else the nearest
/// one: rays are turned into the mesh's frame by its transpose, which must be its inverse.
/// \throw std::invalid_argument for a pose that is not rigid.
Eigen::Matrix3d checked_rotation(std::size_t row, const Pose& pose) {
  constexpr double kExact = 1e-14;
  Eigen::Matrix3d rotation = pose.linear(), product;
  const bool is_exact = skewness(rotation, product) <= kExact;
  if (!is_exact || !(rotation.determinant() > 0.0) || !pose.translation().allFinite() ||
      pose.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    check_rigid("poses[" + std::to_string(row) + "]", pose);
  }
  if (is_exact) return rotation;
  for (int i = 0; i < 4 && skewness(rotation, product) > kExact; ++i) {  // Newton: two steps do
    rotation = rotation * (1.5 * Eigen::Matrix3d::Identity() - 0.5 * product);
  }
  return rotation;
}

InstanceFrame frame_of(std::size_t row, const Pose& pose, double scale, std::int32_t mesh) {
  InstanceFrame frame;
  Eigen::Map<RowMajor3>(&frame.rotation[0][0]) = checked_rotation(row, pose);
  Eigen::Map<Vec3>(frame.position) = pose.translation();
  frame.scale = scale;
  frame.per_metre = 1.0 / scale;
  frame.mesh = mesh;
  frame.at_identity = scale == 1.0 && pose.matrix() == Eigen::Matrix4d::Identity();
  return frame;
}

/// A box in double.
struct Extent3 {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

  Extent3& operator+=(const Extent3& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
    return *this;
  }
};

/// The mesh's box turned into the world, no further from its middle than the mesh reaches; with
/// room for the rounding of what is turned from one frame into the other.
Extent3 extent_in_world(const InstanceFrame& frame, const InstanceMeshes& shared) {
  const auto mesh = static_cast<std::size_t>(frame.mesh);
  const Scene::Hierarchy& hierarchy = *shared.hierarchies[mesh];
  const Vec3 middle = hierarchy.origin + 0.5 * (hierarchy.low + hierarchy.high);
  const Vec3 half = 0.5 * (hierarchy.high - hierarchy.low);
  const Vec3 centre = to_world(frame, middle);
  const Vec3 turned = frame.scale * (rotation_of(frame).cwiseAbs() * half);
  const double most = frame.scale * shared.radius[mesh];
  const double room = kInstancePad * (position_of(frame).lpNorm<1>() +
                                      frame.scale * (middle.lpNorm<1>() + half.lpNorm<1>()));
  const Vec3 reach = turned.cwiseMin(most) + Vec3::Constant(room);
  return {centre - reach, centre + reach};
}

void fill_leaf(const BinaryTree& tree, const BinaryNode& leaf, WideNode& node) {
  for (int lane = 0; lane < kWidth; ++lane) {
    if (lane < static_cast<int>(leaf.item_count())) {
      const Box& box = tree.items[leaf.first_item() + static_cast<std::uint32_t>(lane)];
      set_lane(node, lane, box, ~static_cast<std::int32_t>(box.second_tag()));
    } else {
      clear_lane(node, lane);
    }
  }
}

/// A binary leaf of several instances becomes a node of its own; one alone hangs where it is.
PageArray<WideNode> make_nodes(const BinaryTree& tree) {
  Plan plan;
  if (!tree.nodes[0].is_leaf()) plan = plan_wide_nodes(tree.nodes);
  std::vector<std::uint32_t> full;  // leaves that become nodes
  if (plan.nodes.empty()) full.push_back(0);
  for (WidePlan& node : plan.nodes) {
    for (std::int32_t& child : node.child) {
      if (child >= 0 || child == kNoChild) continue;
      const std::uint32_t leaf = plan.leaves[static_cast<std::size_t>(~child)];
      const BinaryNode& source = tree.nodes[leaf];
      if (source.item_count() == 1) {
        child = ~static_cast<std::int32_t>(tree.items[source.first_item()].second_tag());
      } else {
        child = static_cast<std::int32_t>(plan.nodes.size() + full.size());
        full.push_back(leaf);
      }
    }
  }
  PageArray<WideNode> nodes(plan.nodes.size() + full.size());
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) fill_boxes(tree, plan.nodes[i], nodes[i]);
  for (std::size_t i = 0; i < full.size(); ++i) {
    fill_leaf(tree, tree.nodes[full[i]], nodes[plan.nodes.size() + i]);
  }
  return nodes;
}

void check_counts(std::size_t rows, const std::vector<Pose>& poses,
                  const std::vector<double>& scales) {
  if (poses.size() != rows) {
    throw_argument("poses", "one a mesh (" + std::to_string(rows) + ")",
                   std::to_string(poses.size()));
  }
  if (!scales.empty() && scales.size() != rows) {
    throw_argument("scales", "none, or one a mesh (" + std::to_string(rows) + ")",
                   std::to_string(scales.size()));
  }
}

void check_scale(std::size_t row, double scale) {
  if (scale >= kLeastScale && scale <= kLargestScale) return;
  throw_argument("scales[" + std::to_string(row) + "]", "a number above 0, from 1e-9 to 1e9",
                 to_text(scale));
}

/// Sets the frame of each row; returns the box of all triangles in the world.
Extent3 set_frames(const InstanceMeshes& shared, const std::vector<Pose>& poses,
                   const std::vector<double>& scales, PageArray<InstanceFrame>& frames,
                   int num_threads) {
  return parallel_sum<Extent3>(frames.size(), kInstanceGrain, num_threads,
                               [&](std::size_t begin, std::size_t end) {
                                 Extent3 part;
                                 for (std::size_t i = begin; i < end; ++i) {
                                   const double scale = scales.empty() ? 1.0 : scales[i];
                                   check_scale(i, scale);
                                   frames[i] = frame_of(i, poses[i], scale, shared.number[i]);
                                   if (shared.has_triangles(i))
                                     part += extent_in_world(frames[i], shared);
                                 }
                                 return part;
                               });
}

/// The row at the identity with the most triangles, the first of several; −1 where none is.
std::int32_t find_home(const InstanceMeshes& shared, const PageArray<InstanceFrame>& frames) {
  std::int32_t home = -1;
  std::uint32_t most = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::uint32_t count =
        shared.hierarchies[static_cast<std::size_t>(frames[i].mesh)]->primitive_count;
    if (!frames[i].at_identity || count <= most) continue;
    home = static_cast<std::int32_t>(i);
    most = count;
  }
  return home;
}

/// Boxes in `local` of the rows with triangles.
std::vector<Box> make_boxes(const InstanceMeshes& shared, const PageArray<InstanceFrame>& frames,
                            const LocalFrame& local, int num_threads) {
  std::vector<std::uint32_t> rows;
  rows.reserve(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (shared.has_triangles(i)) rows.push_back(static_cast<std::uint32_t>(i));
  }
  const double room = kInstancePad * local.origin.lpNorm<1>();
  std::vector<Box> boxes(rows.size());
  parallel_for(rows.size(), kInstanceGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Extent3 extent = extent_in_world(frames[rows[i]], shared);
      const Vec3 low = (extent.low - local.origin).array() - room;
      const Vec3 high = (extent.high - local.origin).array() + room;
      boxes[i] = rounded_outwards(low.data(), high.data());
      boxes[i].set_tags(1, rows[i]);
    }
  });
  return boxes;
}

}  // namespace

Vec3 to_world(const InstanceFrame& frame, const Vec3& point) {
  return frame.scale * turn_to_world(frame, point) + position_of(frame);
}

Vec3 to_mesh(const InstanceFrame& frame, const Vec3& point) {
  return frame.per_metre * turn_to_mesh(frame, point - position_of(frame));
}

Vec3 turn_to_world(const InstanceFrame& frame, const Vec3& direction) {
  return rotation_of(frame) * direction;
}

Vec3 turn_to_mesh(const InstanceFrame& frame, const Vec3& direction) {
  return rotation_of(frame).transpose() * direction;
}

Pose pose_of(const InstanceFrame& frame) {
  Pose pose = Pose::Identity();
  pose.linear() = rotation_of(frame);
  pose.translation() = position_of(frame);
  return pose;
}

InstanceMeshes::InstanceMeshes(std::vector<TriangleMesh> given,
                               std::shared_ptr<const Scene::Hierarchy> known, int num_threads)
    : meshes(std::move(given)) {
  using Arrays = std::tuple<const double*, Index, const std::int32_t*, Index>;
  std::map<Arrays, std::int32_t> numbers;
  number.reserve(meshes.size());
  for (const TriangleMesh& mesh : meshes) {
    const auto next = static_cast<std::int32_t>(hierarchies.size());
    const Arrays arrays{mesh.vertices().data(), mesh.vertex_count(), mesh.triangles().data(),
                        mesh.triangle_count()};
    const auto [at, is_new] = numbers.try_emplace(arrays, next);
    number.push_back(at->second);
    if (!is_new) continue;
    hierarchies.push_back(known ? known
                                : std::make_shared<const Scene::Hierarchy>(
                                      std::vector<TriangleMesh>{mesh}, num_threads));
    views.push_back(cast_view(*hierarchies.back()));
    radius.push_back(radius_of(*hierarchies.back(), num_threads));
  }
}

std::size_t InstanceMeshes::memory() const {
  std::size_t bytes = meshes.capacity() * sizeof(TriangleMesh) +
                      number.capacity() * sizeof(std::int32_t) +
                      views.capacity() * sizeof(CastScene);
  for (const auto& hierarchy : hierarchies) bytes += hierarchy->memory();
  return bytes;
}

}  // namespace scene

Scene::Instances::Instances(std::shared_ptr<const scene::InstanceMeshes> given,
                            const std::vector<Pose>& poses, const std::vector<double>& scales,
                            int num_threads)
    : shared(std::move(given)) {
  scene::check_counts(shared->meshes.size(), poses, scales);
  frames = PageArray<scene::InstanceFrame>(shared->meshes.size());
  const scene::Extent3 world = scene::set_frames(*shared, poses, scales, frames, num_threads);
  if (!(world.low.x() <= world.high.x())) return;  // no triangle at all
  const double half = 0.5 * (world.high - world.low).maxCoeff();
  if (!(half <= scene::kLargestReach)) {
    throw_argument("poses", "triangles within 1e12 m of their middle", to_text(half) + " m");
  }
  constexpr double kMostOfIt = 0.25;
  home = scene::find_home(*shared, frames);
  if (home >= 0 && hierarchy(home).reach() < kMostOfIt * half) home = -1;
  origin = home >= 0 ? hierarchy(home).origin
                     : Vec3((0.5 * world.low + 0.5 * world.high).array().round());
  const double room = scene::kInstancePad * origin.lpNorm<1>();
  low = (world.low - origin).array() - room;
  high = (world.high - origin).array() + room;
  const std::vector<scene::Box> boxes = scene::make_boxes(*shared, frames, *this, num_threads);
  nodes = scene::make_nodes(
      scene::build_binary_tree(scene::sort_into_cells(boxes, *this, num_threads), num_threads));
}

scene::InstancedScene Scene::Instances::view() const {
  scene::InstancedScene view;
  view.top = scene::CastScene{};
  view.top.nodes = nodes.data();
  scene::set_local_frame(view.top, *this);
  view.top.far_pad = scene::kInstancePad;
  view.meshes = shared->views.data();
  view.frames = frames.data();
  view.home = home;
  return view;
}

std::size_t Scene::Instances::memory() const {
  return shared->memory() + frames.bytes() + nodes.bytes();
}

}  // namespace bathyal
