// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/devices/thruster.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

double square(double speed) { return speed * std::abs(speed); }

}  // namespace

void ThrusterSide::check(const std::string& name) const {
  check_not_negative(name + ".thrust", thrust);
  check_not_negative(name + ".torque", torque);
  check_not_negative(name + ".speed", speed);
  check_positive(name + ".shape", shape);
  check_not_negative(name + ".voltage_exponent", voltage_exponent);
  check_not_negative(name + ".power_cubic", power_cubic);
  check_not_negative(name + ".power_quartic", power_quartic);
}

void ThrusterOptions::check() const {
  if (!position.allFinite()) throw_argument("position", "finite numbers", "others");
  if (!direction.allFinite() || !(direction.norm() > 0.0)) {
    throw_argument("direction", "a finite vector of a length above 0", "another");
  }
  ahead.check("ahead");
  astern.check("astern");
  check_not_negative("inflow", inflow);
  check_not_negative("torque_inflow", torque_inflow);
  if (spin != 1 && spin != -1) throw_argument("spin", "1 or -1", std::to_string(spin));
  if (!(dead_zone >= 0.0 && dead_zone < 1.0)) {
    throw_argument("dead_zone", "a number from 0 to below 1", to_text(dead_zone));
  }
  check_positive("nominal_voltage", nominal_voltage);
  check_not_negative("lag", lag);
  if (table) table->check();
}

void set_propeller(ThrusterOptions& options, double diameter, std::pair<double, double> thrust,
                   std::pair<double, double> torque, double water_density) {
  check_positive("diameter", diameter);
  check_positive("water_density", water_density);
  check_not_negative("thrust", thrust.first);
  check_not_negative("torque", torque.first);
  check_not_negative("thrust (a loss, given as a slope of 0 or less)", -thrust.second);
  check_not_negative("torque (a loss, given as a slope of 0 or less)", -torque.second);
  const double cube = water_density * std::pow(diameter, 3);
  options.ahead.thrust = options.astern.thrust = cube * diameter * thrust.first;
  options.ahead.torque = options.astern.torque = cube * diameter * diameter * torque.first;
  options.inflow = -cube * thrust.second;
  options.torque_inflow = -cube * diameter * torque.second;
}

Thruster::Thruster(ThrusterOptions options) : options_(std::move(options)) {
  options_.check();
  options_.direction.normalize();
  axis_ << options_.direction, options_.position.cross(options_.direction);
  const ThrusterSide& ahead = options_.ahead;
  const double arm = ahead.thrust > 0.0 ? ahead.torque / ahead.thrust : 0.0;
  column_ = axis_;
  column_.tail<3>() -= options_.spin * arm * options_.direction;
}

double Thruster::settled(double command, double voltage) const {
  const double size = std::min(std::abs(command), 1.0);
  if (!(voltage > 0.0)) return 0.0;
  const double dead = options_.dead_zone * options_.nominal_voltage / voltage;
  if (!(size > dead)) return 0.0;
  const ThrusterSide& way = side(command);
  double speed = way.speed * std::pow((size - dead) / (1.0 - dead), way.shape);
  if (way.voltage_exponent != 0.0) {
    speed *= std::pow(voltage / options_.nominal_voltage, way.voltage_exponent);
  }
  return std::copysign(speed, command);
}

ThrusterDrive Thruster::drive(double command, double voltage) const {
  if (!options_.table) return {settled(command, voltage), 0.0, 0.0};
  if (!(voltage > 0.0)) return {};
  const ThrusterPoint point = options_.table->at(command, voltage);
  const ThrusterDrive law{point.speed, 0.0, 0.0};
  return {point.speed, point.thrust - thrust(point.speed, law),
          point.power - power(point.speed, law)};
}

ThrusterState Thruster::advanced(const ThrusterState& state, const ThrusterDrive& drive,
                                 double time) const {
  if (options_.lag == 0.0) return {drive.speed};
  return {drive.speed + (state.speed - drive.speed) * std::exp(-time / options_.lag)};
}

double Thruster::thrust(double speed, const ThrusterDrive& drive, double inflow_speed) const {
  return side(speed).thrust * square(speed) - options_.inflow * std::abs(speed) * inflow_speed +
         drive.thrust;
}

double Thruster::torque(double speed, double inflow_speed) const {
  return side(speed).torque * square(speed) -
         options_.torque_inflow * std::abs(speed) * inflow_speed;
}

double Thruster::power(double speed, const ThrusterDrive& drive) const {
  const ThrusterSide& way = side(speed);
  const double size = std::abs(speed), cube = size * size * size;
  return std::max(0.0, (way.power_cubic + way.power_quartic * size) * cube + drive.power);
}

Vec6 Thruster::still_wrench(double speed, const ThrusterDrive& drive) const {
  Vec6 result = thrust(speed, drive) * axis_;
  result.tail<3>() -= options_.spin * torque(speed) * options_.direction;
  return result;
}

Vec6 Thruster::inflow_wrench(double speed, const Vec6& relative) const {
  const double loss = -std::abs(speed) * axis_.dot(relative);  // d · (v + ω × r)
  Vec6 result = options_.inflow * loss * axis_;
  result.tail<3>() -= options_.spin * options_.torque_inflow * loss * options_.direction;
  return result;
}

Vec6 Thruster::wrench(double speed, const ThrusterDrive& drive, const Vec6& relative) const {
  return still_wrench(speed, drive) + inflow_wrench(speed, relative);
}

ThrusterPoint Thruster::steady(double command, double voltage) const {
  const ThrusterDrive reached = drive(command, voltage);
  return {thrust(reached.speed, reached), power(reached.speed, reached), reached.speed};
}

double Thruster::command_in_table(double thrust, double voltage) const {
  const std::vector<double>& command = options_.table->command;
  double best = 0.0, least = std::abs(thrust - options_.table->at(0.0, voltage).thrust);
  double before = options_.table->at(command.front(), voltage).thrust;
  const auto keep = [&](double found, double given) {
    const double off = std::abs(given - thrust);
    if (off < least || (off == least && std::abs(found) < std::abs(best))) {
      best = found;
      least = off;
    }
  };
  keep(command.front(), before);
  for (std::size_t k = 1; k < command.size(); ++k) {
    const double here = options_.table->at(command[k], voltage).thrust;
    const double share = here != before ? (thrust - before) / (here - before) : -1.0;
    if (share >= 0.0 && share <= 1.0) {
      keep(command[k - 1] + share * (command[k] - command[k - 1]), thrust);
    }
    keep(command[k], here);
    before = here;
  }
  return best;
}

double Thruster::command_for(double thrust, double voltage) const {
  if (thrust == 0.0 || !(voltage > 0.0)) return 0.0;
  if (options_.table) return command_in_table(thrust, voltage);
  const ThrusterSide& way = side(thrust);
  if (!(way.thrust > 0.0) || !(way.speed > 0.0)) return 0.0;
  const double dead = options_.dead_zone * options_.nominal_voltage / voltage;
  const double scale = std::pow(voltage / options_.nominal_voltage, way.voltage_exponent);
  const double speed = std::sqrt(std::abs(thrust) / way.thrust) / (way.speed * scale);
  const double past = std::pow(std::min(speed, 1.0), 1.0 / way.shape);
  return std::copysign(std::min(dead + (1.0 - dead) * past, 1.0), thrust);
}

}  // namespace bathyal
