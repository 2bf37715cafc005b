// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "bathyal/arm/statics.hpp"
#include "bathyal/workspace/workspace.hpp"

// What an arm, with all that is attached to it, does to the vehicle that carries it.

namespace bathyal {

struct WrenchOptions {
  Vec3 gravity = {0.0, 0.0, -9.80665};  ///< in the world [m/s²]
  double water_density = 1025.0;        ///< [kg/m³], 0 or more; 0 in air
  /// When each row is taken [s], for the vehicle's pose: none (at 0), one for all, or one a row.
  std::span<const double> time = {};
  /// Rates of the coordinates, (N, n) [rad/s, m/s]; null: the arm is at rest.
  const JointMatrix* velocity = nullptr;
  /// Of the rates, (N, n) [rad/s², m/s²]; null: they do not change.
  const JointMatrix* acceleration = nullptr;
  int num_threads = 0;

  /// \throw std::invalid_argument
  void check() const;
};

/// Force and moment on the vehicle, in its frame about its origin [N, N m], (N, 6), exerted by the
/// arm, by what is attached to it and through it by the bottom:
///
///   Σ over bodies [m g at the centre of mass, − ρ V g at the centre of buoyancy]
///   + contact at the tool centre point − d/dt (momentum of the bodies).
///
/// Bodies are the arm's links, its foot included, and Workspace::attached; a mass or volume of 0,
/// unknown, adds nothing. Gravity is turned into the vehicle's frame by world_from_vehicle. The
/// last term is there where rates or accelerations are given, the vehicle taken to be at rest;
/// water adds neither mass nor drag.
///
/// `contact`: force and moment that the bottom exerts on the tool, at the tool centre point along
/// the vehicle's axes; no row (nothing is touched), one for all, or one a row of q. (Of the other
/// sign than the wrench of `statics`, which the tool exerts.)
/// \throw std::invalid_argument as check_joint_values, for rates, accelerations, contacts or times
///        of another count or not finite, for options out of range.
std::vector<double> vehicle_wrench(const Workspace& workspace, JointView q, Wrenches contact,
                                   const WrenchOptions& options = {});

/// The same of an arm whose base is in the vehicle's frame, with a body fixed to its tool. `q` is
/// one row or more.
std::vector<double> vehicle_wrench(const Arm& arm, const RigidBody& attached,
                                   const Trajectory& world_from_vehicle, JointView q,
                                   Wrenches contact, const WrenchOptions& options = {});

/// Linear momentum [kg m/s] and angular momentum about the vehicle's origin [kg m²/s] of links and
/// attached body, (N, 6), in the vehicle's frame, seen from the vehicle.
/// \throw std::invalid_argument as check_joint_values, for rates of another shape.
std::vector<double> arm_momentum(const Workspace& workspace, JointView q, JointView velocity,
                                 int num_threads = 0);

/// Rates and accelerations at the rows of a timed motion, (N, n) each.
struct JointRates {
  JointMatrix velocity;
  JointMatrix acceleration;
};

/// By differences: the rate at a row is the mean of those before and after it, weighted by the
/// other's interval (second order); the acceleration is their difference over half of both
/// intervals. The arm rests before the first and after the last row, so the accelerations, each
/// over its half intervals, add up to nothing.
/// \throw std::invalid_argument for another count of times, or times that do not rise.
JointRates joint_rates(JointView q, std::span<const double> time);

}  // namespace bathyal
