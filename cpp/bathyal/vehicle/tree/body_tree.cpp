// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/tree/body_tree.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/vehicle/tree/internal/spatial.hpp"

namespace bathyal {

using tree::Inertia;
using tree::Placement;

struct BodyTree::Body {
  int parent;
  TreeJoint joint;
  int along;          // the joint's entry of a six-vector: 2 or 5; of a fixed one not looked at
  Pose parent_from;   // while the coordinate is 0, between frames whose z is the axis
  Pose link_from;     // this frame in the link's own
  Mat6 rigid, added;  // about this frame
  Inertia inertia;    // their sum
  double mass, volume;
  Vec3 center_of_mass, center_of_buoyancy;
  std::vector<DragStrip> strips;

  explicit Body(const TreeLink& link, const Pose& parent_link_from);

  bool moves() const { return joint != TreeJoint::kFixed; }
  Placement placement(double q) const;
  void add_drag(const Vec6& relative, Vec6& force) const;
};

/// In the link's frame, whose z is the joint's axis.
struct BodyTree::Passing {
  Placement placement;
  Vec3 down, water, pushed;
  Vec6 velocity, change, force;  // change: v × S rate
  Inertia inertia;               // articulated
  Vec6 column;                   // inertia · S
  double own, left;              // Sᵀ column; effort less what resists
  Vec6 acceleration;
};

namespace {

Pose turned_to(const Vec3& axis) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis).toRotationMatrix();
  return pose;
}

Placement placement_of(const Pose& pose) { return {pose.linear(), pose.translation()}; }

/// The tip's load acts along the hull's axes.
Vec6 at_tip(const Vec6& load, const Eigen::Matrix3d& hull_from_link, const Vec3& tip) {
  Vec6 force;
  force.head<3>() = hull_from_link.transpose() * load.head<3>();
  force.tail<3>() = hull_from_link.transpose() * load.tail<3>() + tip.cross(force.head<3>());
  return force;
}

}  // namespace

BodyTree::Body::Body(const TreeLink& link, const Pose& parent_link_from)
    : parent(link.parent),
      joint(link.joint),
      along(link.joint == TreeJoint::kPrismatic ? 2 : 5),
      link_from(turned_to(link.axis)),
      mass(link.body.mass),
      volume(link.body.volume),
      strips(link.strips) {
  const Pose from_link = link_from.inverse();
  parent_from = parent_link_from.inverse() * link.parent_from_link * link_from;
  const RigidBody body = in_frame(link.body, from_link);
  rigid = mass_matrix(body);
  added = tree::outward(placement_of(from_link), Inertia(link.added_mass)).whole();
  inertia = Inertia(rigid + added);
  center_of_mass = body.center_of_mass;
  center_of_buoyancy = body.center_of_buoyancy;
  for (DragStrip& strip : strips) {
    strip.center = from_link * strip.center;
    strip.axis = from_link.linear() * strip.axis;
  }
}

Placement BodyTree::Body::placement(double q) const {
  Placement at{parent_from.linear(), parent_from.translation()};
  if (joint == TreeJoint::kPrismatic) {
    at.place += q * parent_from.linear().col(2);
    return at;
  }
  if (joint == TreeJoint::kFixed) return at;
  const double c = std::cos(q), s = std::sin(q);
  at.turn.col(0) = c * parent_from.linear().col(0) + s * parent_from.linear().col(1);
  at.turn.col(1) = c * parent_from.linear().col(1) - s * parent_from.linear().col(0);
  return at;
}

void BodyTree::Body::add_drag(const Vec6& relative, Vec6& force) const {
  const Vec3 linear = relative.head<3>(), spin = relative.tail<3>();
  for (const DragStrip& strip : strips) {
    const Vec3 past = linear + spin.cross(strip.center);
    const Vec3 across = past - past.dot(strip.axis) * strip.axis;
    const Vec3 push = -strip.coefficient * across.norm() * across;
    force.head<3>() += push;
    force.tail<3>() += strip.center.cross(push);
  }
}

BodyTree::BodyTree(BodyTreeOptions options)
    : options_((options.check(), std::make_shared<const BodyTreeOptions>(std::move(options)))),
      vehicle_(options_->vehicle) {
  for (const TreeLink& link : options_->links) {
    const Pose parent = link.parent < 0 ? Pose::Identity()
                                        : links_[static_cast<std::size_t>(link.parent)].link_from;
    links_.emplace_back(link, parent);
  }
}

BodyTree::~BodyTree() = default;
BodyTree::BodyTree(const BodyTree&) = default;
BodyTree& BodyTree::operator=(const BodyTree&) = default;
BodyTree::BodyTree(BodyTree&&) noexcept = default;
BodyTree& BodyTree::operator=(BodyTree&&) noexcept = default;

std::size_t BodyTree::size() const { return links_.size(); }

BodyTreeState BodyTree::rest() const {
  return {{}, std::vector<double>(size(), 0.0), std::vector<double>(size(), 0.0)};
}

void BodyTree::check_sizes(const BodyTreeState& state) const {
  const auto check = [&](std::string_view name, std::size_t count) {
    if (count == size()) return;
    throw_argument(name, std::to_string(size()) + " numbers", std::to_string(count));
  };
  check("q", state.q.size());
  check("rate", state.rate.size());
}

/// Velocities and forces, the hull first.
void BodyTree::outward(const BodyTreeState& state, const TreeLoads& loads, Passing* all) const {
  const Eigen::Matrix3d hull_from_world = state.base.world_from_vehicle.linear().transpose();
  const VehicleOptions& hull = options_->vehicle;
  const Vec3 hull_down = -hull_from_world.col(2);
  const Vec3 hull_water = hull_from_world * loads.flow.velocity;
  const Vec3 hull_pushed = hull_from_world * loads.flow.acceleration;
  for (std::size_t k = 0; k < links_.size(); ++k) {
    const Body& body = links_[k];
    Passing& here = all[k];
    const Passing* parent = body.parent < 0 ? nullptr : all + body.parent;
    here.placement = body.placement(state.q[k]);
    const Eigen::Matrix3d back = here.placement.turn.transpose();
    here.down = back * (parent ? parent->down : hull_down);
    here.water = back * (parent ? parent->water : hull_water);
    here.pushed = back * (parent ? parent->pushed : hull_pushed);
    here.velocity = here.placement.motion_inward(parent ? parent->velocity : state.base.velocity);
    here.change.setZero();
    if (body.moves()) {
      here.velocity[body.along] += state.rate[k];
      Vec6 joint_rate = Vec6::Zero();
      joint_rate[body.along] = state.rate[k];
      here.change = tree::cross_motion(here.velocity, joint_rate);
    }

    const Vec3 spin = here.velocity.tail<3>();
    Vec6 relative = here.velocity, water_change = Vec6::Zero();
    relative.head<3>() -= here.water;
    water_change.head<3>() = here.pushed - spin.cross(here.water);
    here.force = body.added * water_change - coriolis(body.rigid, here.velocity) -
                 coriolis(body.added, relative);
    body.add_drag(relative, here.force);
    const Vec3 weight = body.mass * hull.gravity * here.down;
    const Vec3 lift = hull.water_density * body.volume * (here.pushed - hull.gravity * here.down);
    here.force.head<3>() += weight + lift;
    here.force.tail<3>() += body.center_of_mass.cross(weight) + body.center_of_buoyancy.cross(lift);
    here.inertia = body.inertia;
  }
}

void BodyTree::push_tip(const TreeLoads& loads, Passing* all) const {
  if (links_.empty() || loads.tip_wrench.isZero(0.0)) return;
  Eigen::Matrix3d hull_from_link = Eigen::Matrix3d::Identity();
  for (int k = static_cast<int>(size()) - 1; k >= 0;
       k = links_[static_cast<std::size_t>(k)].parent) {
    hull_from_link = all[k].placement.turn * hull_from_link;
  }
  const Vec3 tip = links_.back().link_from.linear().transpose() * options_->tip;
  all[size() - 1].force += at_tip(loads.tip_wrench, hull_from_link, tip);
}

void BodyTree::accelerations(const BodyTreeState& state, const TreeLoads& loads,
                             TreeAcceleration& found) const {
  check_sizes(state);
  if (!loads.joints.empty() && loads.joints.size() != size()) {
    throw_argument("joints", std::to_string(size()) + " numbers or none",
                   std::to_string(loads.joints.size()));
  }
  const bool carried_out = loads.drive == JointDrive::kAcceleration;
  const auto joint_of = [&](std::size_t k) {
    return loads.joints.empty() || !links_[k].moves() ? 0.0 : loads.joints[k];
  };
  std::array<Passing, kMostLinks> all;
  outward(state, loads, all.data());
  push_tip(loads, all.data());
  Vec6 base_force = vehicle_.force(state.base, loads.wrench, loads.flow);
  if (links_.empty())
    base_force += at_tip(loads.tip_wrench, Eigen::Matrix3d::Identity(), options_->tip);
  Inertia base_inertia(vehicle_.mass_matrix());

  for (std::size_t k = size(); k-- > 0;) {
    const Body& body = links_[k];
    Passing& here = all[k];
    const bool given = carried_out || !body.moves();
    const double joint = joint_of(k);
    Inertia carried = here.inertia;
    Vec6 change = here.change;
    if (given) {
      change[body.along] += joint;
    } else {
      here.column = here.inertia.column(body.along);
      here.own = here.column[body.along];
      if (!(here.own > 0.0)) {
        throw_argument("links", "mass or added mass behind each joint that moves",
                       "none behind " + options_->links[k].name);
      }
      here.left = joint + here.force[body.along];
      carried.take_away(here.column, here.own);
    }
    Vec6 force = here.force - carried * change;
    if (!given) force -= here.column * (here.left / here.own);
    const Inertia outer = tree::outward(here.placement, carried);
    if (body.parent < 0) {
      base_inertia.add(outer);
      base_force += here.placement.force_outward(force);
    } else {
      Passing& parent = all[static_cast<std::size_t>(body.parent)];
      parent.inertia.add(outer);
      parent.force += here.placement.force_outward(force);
    }
  }

  found.base = base_inertia.whole().llt().solve(base_force);
  found.joints.resize(size());
  found.efforts.resize(size());
  for (std::size_t k = 0; k < size(); ++k) {
    const Body& body = links_[k];
    Passing& here = all[k];
    const Vec6& parent =
        body.parent < 0 ? found.base : all[static_cast<std::size_t>(body.parent)].acceleration;
    here.acceleration = here.placement.motion_inward(parent) + here.change;
    const bool given = carried_out || !body.moves();
    const double joint = joint_of(k);
    found.joints[k] = given ? joint : (here.left - here.column.dot(here.acceleration)) / here.own;
    found.efforts[k] = joint;
    if (!body.moves()) continue;
    here.acceleration[body.along] += found.joints[k];
    if (given) {
      found.efforts[k] =
          here.inertia.column(body.along).dot(here.acceleration) - here.force[body.along];
    }
  }
}

double BodyTree::kinetic_energy(const BodyTreeState& state) const {
  check_sizes(state);
  std::array<Passing, kMostLinks> all;
  outward(state, {}, all.data());
  double energy = vehicle_.kinetic_energy(state.base.velocity);
  for (std::size_t k = 0; k < size(); ++k) {
    energy += 0.5 * all[k].velocity.dot(links_[k].inertia * all[k].velocity);
  }
  return energy;
}

std::vector<Pose> BodyTree::link_poses(const BodyTreeState& state) const {
  check_sizes(state);
  std::vector<Pose> own, poses;
  for (std::size_t k = 0; k < size(); ++k) {
    const Placement at = links_[k].placement(state.q[k]);
    Pose pose = Pose::Identity();
    pose.linear() = at.turn;
    pose.translation() = at.place;
    const int parent = links_[k].parent;
    own.push_back(parent < 0 ? pose : own[static_cast<std::size_t>(parent)] * pose);
    poses.push_back(own.back() * links_[k].link_from.inverse());
  }
  return poses;
}

double BodyTree::potential_energy(const BodyTreeState& state) const {
  const VehicleOptions& hull = options_->vehicle;
  const auto height = [&](const Pose& world_from_body, const RigidBody& body) {
    return body.mass * (world_from_body * body.center_of_mass).z() -
           hull.water_density * body.volume * (world_from_body * body.center_of_buoyancy).z();
  };
  const Pose& world = state.base.world_from_vehicle;
  double sum = height(world, hull.body);
  const std::vector<Pose> poses = link_poses(state);
  for (std::size_t k = 0; k < size(); ++k) {
    sum += height(world * poses[k], options_->links[k].body);
  }
  return hull.gravity * sum;
}

Momentum BodyTree::momentum(const BodyTreeState& state) const {
  check_sizes(state);
  std::array<Passing, kMostLinks> all;
  outward(state, {}, all.data());
  std::array<Vec6, kMostLinks> carried;
  for (std::size_t k = 0; k < size(); ++k) carried[k] = links_[k].inertia * all[k].velocity;
  Vec6 sum = vehicle_.mass_matrix() * state.base.velocity;
  for (std::size_t k = size(); k-- > 0;) {
    const int parent = links_[k].parent;
    (parent < 0 ? sum : carried[static_cast<std::size_t>(parent)]) +=
        all[k].placement.force_outward(carried[k]);
  }
  return placement_of(state.base.world_from_vehicle).force_outward(sum);
}

}  // namespace bathyal
