// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/vehicle/devices/thruster_fit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "bathyal/base/check.hpp"

namespace bathyal {
namespace {

struct Row {
  double command, voltage;  // |command|
  double thrust, power, speed;
};

/// Of one side, as sizes.
std::vector<Row> rows_of(const ThrusterTable& table, double way) {
  std::vector<Row> rows;
  for (std::size_t r = 0; r < table.voltage.size(); ++r) {
    for (std::size_t c = 0; c < table.command.size(); ++c) {
      const ThrusterPoint point = table.measured(r, c);
      if (!(way * point.thrust > 0.0) || !(way * point.speed > 0.0)) continue;
      rows.push_back({way * table.command[c], table.voltage[r], way * point.thrust, point.power,
                      way * point.speed});
    }
  }
  return rows;
}

double fitted_thrust(const std::vector<Row>& rows) {
  double above = 0.0, below = 0.0;
  for (const Row& row : rows) {
    const double square = row.speed * row.speed;
    above += row.thrust * square;
    below += square * square;
  }
  return above / below;
}

/// Mean of (the largest command that gives no thrust) · voltage, over voltages and sides.
double dead_volts(const ThrusterTable& table) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t r = 0; r < table.voltage.size(); ++r) {
    double low = 0.0, high = 0.0;
    for (std::size_t c = 0; c < table.command.size(); ++c) {
      if (table.measured(r, c).thrust != 0.0) continue;
      low = std::min(low, table.command[c]);
      high = std::max(high, table.command[c]);
    }
    sum += 0.5 * (high - low) * table.voltage[r];
    ++count;
  }
  return sum / count;
}

void fit_speed(ThrusterSide& side, const std::vector<Row>& rows, double dead, double nominal,
               bool several) {
  const Eigen::Index unknowns = several ? 3 : 2;
  Eigen::MatrixXd terms(rows.size(), unknowns);
  Eigen::VectorXd values(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double start = dead / rows[i].voltage;
    const double past = std::max((rows[i].command - start) / (1.0 - start), 1e-3);
    const double weight = rows[i].speed * rows[i].speed;
    const auto k = static_cast<Eigen::Index>(i);
    terms(k, 0) = weight;
    terms(k, 1) = weight * std::log(past);
    if (several) terms(k, 2) = weight * std::log(rows[i].voltage / nominal);
    values[k] = weight * std::log(rows[i].speed);
  }
  const Eigen::VectorXd found = terms.colPivHouseholderQr().solve(values);
  side.speed = std::exp(found[0]);
  side.shape = found[1];
  side.voltage_exponent = several ? found[2] : 0.0;
}

void fit_power(ThrusterSide& side, const std::vector<Row>& rows) {
  Eigen::MatrixXd terms(rows.size(), 2);
  Eigen::VectorXd values(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    terms(k, 0) = std::pow(rows[i].speed, 3);
    terms(k, 1) = std::pow(rows[i].speed, 4);
    values[k] = rows[i].power;
  }
  const Eigen::Vector2d found = terms.colPivHouseholderQr().solve(values);
  side.power_cubic = found[0];
  side.power_quartic = found[1];
  if (found.minCoeff() >= 0.0) return;  // else the one term that keeps power from falling below 0
  side.power_cubic = terms.col(0).dot(values) / terms.col(0).squaredNorm();
  side.power_quartic = 0.0;
}

double rms_thrust(const ThrusterSide& side, const std::vector<Row>& rows) {
  double sum = 0.0;
  for (const Row& row : rows) sum += std::pow(side.thrust * row.speed * row.speed - row.thrust, 2);
  return std::sqrt(sum / static_cast<double>(rows.size()));
}

}  // namespace

ThrusterFit fit_thruster(const ThrusterTable& table, double nominal_voltage) {
  table.check();
  check_positive("nominal_voltage", nominal_voltage);
  ThrusterFit fit;
  fit.options.nominal_voltage = nominal_voltage;
  const double dead = dead_volts(table);
  fit.options.dead_zone = dead / nominal_voltage;
  double power = 0.0, thrust = 0.0, count = 0.0;
  for (const double way : {1.0, -1.0}) {
    ThrusterSide& side = way > 0.0 ? fit.options.ahead : fit.options.astern;
    const std::vector<Row> rows = rows_of(table, way);
    if (rows.size() < 4) {
      throw_argument("table", "4 rows or more with thrust ahead, and as many astern",
                     std::to_string(rows.size()) + (way > 0.0 ? " ahead" : " astern"));
    }
    side.thrust = fitted_thrust(rows);
    fit_speed(side, rows, dead, nominal_voltage, table.voltage.size() > 1);
    fit_power(side, rows);
    (way > 0.0 ? fit.rms_ahead : fit.rms_astern) = rms_thrust(side, rows);
  }
  const Thruster law(fit.options);
  for (const double way : {1.0, -1.0}) {
    for (const Row& row : rows_of(table, way)) {
      thrust += std::pow(law.steady(way * row.command, row.voltage).thrust - way * row.thrust, 2);
      power += std::pow(law.power(way * row.speed, {}) - row.power, 2);
      count += 1.0;
    }
  }
  fit.rms_command = std::sqrt(thrust / count);
  fit.rms_power = std::sqrt(power / count);
  return fit;
}

}  // namespace bathyal
