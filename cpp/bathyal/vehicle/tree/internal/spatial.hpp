// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bathyal/vehicle/vehicle.hpp"

// Vectors and matrices of six, linear parts first, moved between frames.

namespace bathyal::tree {

/// (a × b) for a fixed a, as a matrix.
inline Eigen::Matrix3d cross_matrix(const Vec3& a) {
  Eigen::Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

/// Where a frame lies in its parent's.
struct Placement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 place = Vec3::Zero();

  /// A velocity or acceleration of the parent, in the frame.
  Vec6 motion_inward(const Vec6& parent) const {
    Vec6 own;
    own.head<3>() = turn.transpose() * (parent.head<3>() + parent.tail<3>().cross(place));
    own.tail<3>() = turn.transpose() * parent.tail<3>();
    return own;
  }

  /// A force of the frame, in the parent.
  Vec6 force_outward(const Vec6& own) const {
    Vec6 parent;
    parent.head<3>() = turn * own.head<3>();
    parent.tail<3>() = turn * own.tail<3>() + place.cross(parent.head<3>());
    return parent;
  }
};

/// A symmetric (6, 6) matrix of inertia, by its blocks.
struct Inertia {
  Eigen::Matrix3d linear;   ///< force by linear acceleration
  Eigen::Matrix3d mixed;    ///< force by angular acceleration
  Eigen::Matrix3d angular;  ///< moment by angular acceleration

  explicit Inertia(const Mat6& whole)
      : linear(whole.topLeftCorner<3, 3>()),
        mixed(whole.topRightCorner<3, 3>()),
        angular(whole.bottomRightCorner<3, 3>()) {}
  Inertia() = default;

  Vec6 operator*(const Vec6& motion) const {
    Vec6 force;
    force.head<3>() = linear * motion.head<3>() + mixed * motion.tail<3>();
    force.tail<3>() = mixed.transpose() * motion.head<3>() + angular * motion.tail<3>();
    return force;
  }

  /// Column `axis` of the whole, 0 to 5.
  Vec6 column(int axis) const {
    Vec6 force;
    if (axis < 3) {
      force << linear.col(axis), mixed.row(axis).transpose();
    } else {
      force << mixed.col(axis - 3), angular.col(axis - 3);
    }
    return force;
  }

  Mat6 whole() const {
    Mat6 all;
    all << linear, mixed, mixed.transpose(), angular;
    return all;
  }

  void add(const Inertia& other) {
    linear += other.linear;
    mixed += other.mixed;
    angular += other.angular;
  }

  /// Less column columnᵀ / divisor.
  void take_away(const Vec6& column, double divisor) {
    const Vec3 force = column.head<3>() / divisor, moment = column.tail<3>() / divisor;
    linear.noalias() -= force * column.head<3>().transpose();
    mixed.noalias() -= force * column.tail<3>().transpose();
    angular.noalias() -= moment * column.tail<3>().transpose();
  }
};

/// The inertia of a frame, in its parent: Xᵀ I X with X = motion_inward.
inline Inertia outward(const Placement& at, const Inertia& own) {
  const Eigen::Matrix3d back = at.turn.transpose();
  Inertia parent;
  parent.linear.noalias() = (at.turn * own.linear) * back;
  const Eigen::Matrix3d mixed = (at.turn * own.mixed) * back;
  const Eigen::Matrix3d arm = cross_matrix(at.place);
  parent.mixed.noalias() = mixed - parent.linear * arm;
  const Eigen::Matrix3d lever = arm * mixed;
  parent.angular.noalias() = (at.turn * own.angular) * back;
  parent.angular += lever + lever.transpose();
  parent.angular.noalias() -= (arm * parent.linear) * arm;
  return parent;
}

/// v × m: how a moving frame changes a motion that is at rest in it.
inline Vec6 cross_motion(const Vec6& velocity, const Vec6& motion) {
  const Vec3 spin = velocity.tail<3>();
  Vec6 change;
  change.head<3>() = spin.cross(motion.head<3>()) + velocity.head<3>().cross(motion.tail<3>());
  change.tail<3>() = spin.cross(motion.tail<3>());
  return change;
}

}  // namespace bathyal::tree
