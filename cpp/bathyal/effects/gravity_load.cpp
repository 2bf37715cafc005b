// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/effects/gravity_load.hpp"

#include <algorithm>

namespace bathyal {
namespace {

/// Along the coordinate of a joint whose frame is `frame`.
double pull_along(const Joint& joint, const Pose& frame, const Burden& burden,
                  const Vec3& gravity) {
  const Vec3 axis = frame.linear().col(2);
  if (joint.type == JointType::kPrismatic)
    return joint.multiplier * burden.mass * axis.dot(gravity);
  const Vec3 lever = burden.moment - burden.mass * frame.translation();
  return joint.multiplier * axis.dot(lever.cross(gravity));
}

}  // namespace

bool masses_known(const Arm& arm) {
  return std::any_of(arm.links().begin() + 1, arm.links().end(),
                     [](const Link& link) { return link.body.mass > 0.0; });
}

Eigen::VectorXd payload_of(const EffectData& data) {
  if (data.has("payload")) return data.covariate("payload").col(0);
  return Eigen::VectorXd::Zero(data.rows());
}

GravityLoads::GravityLoads(const EffectData& data, Bodies bodies, Eigen::VectorXd payload)
    : data_(data) {
  Arm arm = *data.arm;
  arm.set_base(Pose::Identity());
  const std::size_t links = arm.links().size();
  for (Index i = 0; i < data.rows(); ++i) {
    RowFrames& frames = frames_.emplace_back();
    compute_row_frames(arm, {data.q.row(i).data(), static_cast<std::size_t>(data.q.cols())},
                       frames);
    std::vector<Burden>& beyond = beyond_.emplace_back(links + 1);
    beyond[links] = {payload[i], payload[i] * frames.world_from_tool.translation()};
    for (std::size_t k = links; k-- > 0;) {
      beyond[k] = beyond[k + 1];
      if (bodies == Bodies::kNone) continue;
      const Link& link = arm.links()[k];
      const Vec3 center =
          frames.world_from_row[k] * (link.row_from_link * link.body.center_of_mass);
      beyond[k].mass += link.body.mass;
      beyond[k].moment += link.body.mass * center;
    }
  }
}

GravityLoad GravityLoads::beyond(Index row, std::size_t link, const Vec3& center) const {
  const Burden& burden = beyond_[row][link];
  const Vec3 gravity = data_.gravity.row(row);
  return {burden.mass * gravity, (burden.moment - burden.mass * center).cross(gravity)};
}

Eigen::VectorXd GravityLoads::torque(int coordinate) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(data_.rows());
  const std::vector<Joint>& joints = data_.arm->joints();
  for (Index i = 0; i < data_.rows(); ++i) {
    for (std::size_t k = 0; k < joints.size(); ++k) {
      if (joints[k].coordinate != coordinate) continue;
      out[i] += pull_along(joints[k], frames_[i].world_from_row[k], beyond_[i][k + 1],
                           data_.gravity.row(i));
    }
  }
  return out;
}

double GravityLoads::torque_of(int coordinate, Index row, std::size_t link,
                               const Burden& body) const {
  double out = 0.0;
  const std::vector<Joint>& joints = data_.arm->joints();
  for (std::size_t k = 0; k < std::min(link, joints.size()); ++k) {
    if (joints[k].coordinate != coordinate) continue;
    out += pull_along(joints[k], frames_[row].world_from_row[k], body, data_.gravity.row(row));
  }
  return out;
}

}  // namespace bathyal
