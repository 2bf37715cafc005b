// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/protocol/pd6.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/protocol/internal/fields.hpp"

namespace bathyal {
namespace {

constexpr double kMostSpeed = 99.999;  // [m/s]
constexpr double kMost = 1e6;          // of any field

/// "+0012.50": a sign, at least `whole` digits, `decimals` behind the point.
void append_signed(std::string& text, double value, int whole, int decimals) {
  std::array<char, 64> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), std::abs(value),
                                 std::chars_format::fixed, decimals)
                       .ptr;
  const auto size = static_cast<std::size_t>(end - digits.data());
  const std::size_t width =
      static_cast<std::size_t>(whole) + (decimals > 0 ? static_cast<std::size_t>(decimals) + 1 : 0);
  text += std::signbit(value) ? '-' : '+';
  text.append(width > size ? width - size : 0, '0').append(digits.data(), size);
}

void append_plain(std::string& text, double value, int whole, int decimals) {
  std::string with_sign;
  append_signed(with_sign, value, whole, decimals);
  text.append(with_sign, 1);
}

void append_two(std::string& text, std::int64_t value) {
  text += static_cast<char>('0' + value / 10 % 10);
  text += static_cast<char>('0' + value % 10);
}

double turned(double degrees) {
  const double found = std::fmod(degrees, 360.0);
  return found < 0.0 ? found + 360.0 : found;
}

double number(std::string_view field) { return number_of("PD6", field, -kMost, kMost); }

void need(const std::vector<std::string_view>& fields, std::size_t count) {
  if (fields.size() == count) return;
  std::string expected(std::to_string(count));
  throw_field("PD6", expected.append(" fields of ").append(fields[0]),
              std::to_string(fields.size()));
}

int two_digits(std::string_view text, std::size_t at) {
  const char tens = text[at], ones = text[at + 1];
  if (tens < '0' || tens > '9' || ones < '0' || ones > '9') {
    throw_field("PD6", "a time", text);
  }
  return 10 * (tens - '0') + (ones - '0');
}

void read_stamp(std::string_view stamp, Pd6Ensemble& ensemble) {
  if (stamp.size() != 14) throw_field("PD6", "a time of 14 digits", stamp);
  ensemble.year = 2000 + two_digits(stamp, 0);
  ensemble.month = two_digits(stamp, 2);
  ensemble.day = two_digits(stamp, 4);
  ensemble.time = 3600.0 * two_digits(stamp, 6) + 60.0 * two_digits(stamp, 8) +
                  two_digits(stamp, 10) + 0.01 * two_digits(stamp, 12);
}

}  // namespace

std::string pd6_text(const Pd6Ensemble& e) {
  check_range("heading", e.heading, -1e6, 1e6);
  check_range("pitch", e.pitch, -99.99, 99.99);
  check_range("roll", e.roll, -180.0, 180.0);
  check_range("time", e.time, 0.0, 86'400.0);
  check_range("sound_speed", e.sound_speed, 0.0, 9999.9);
  check_range("depth", e.depth, -9999.9, 9999.9);
  for (Eigen::Index i = 0; i < 3; ++i) {
    check_range("velocity", e.velocity[i], -kMostSpeed, kMostSpeed);
  }
  check_range("altitude", e.altitude.value_or(0.0), 0.0, 9999.99);
  check_range("age", e.age, 0.0, 999.99);
  const auto hundredths = static_cast<std::int64_t>(std::llround(e.time * 100.0)) % 8'640'000;
  std::string text(":SA,");
  append_signed(text, e.pitch, 2, 2);
  text += ',';
  append_signed(text, e.roll, 2, 2);
  text += ',';
  append_plain(text, turned(e.heading), 3, 2);
  text.append("\r\n:TS,");
  for (const std::int64_t part :
       {static_cast<std::int64_t>(e.year % 100), static_cast<std::int64_t>(e.month),
        static_cast<std::int64_t>(e.day), hundredths / 360'000, hundredths / 6000 % 60,
        hundredths / 100 % 60, hundredths % 100}) {
    append_two(text, part);
  }
  text.append(",35.0,+10.0,");
  append_plain(text, std::max(0.0, e.depth), 4, 1);
  text += ',';
  append_plain(text, e.sound_speed, 4, 1);
  text.append(",0\r\n:BS");
  const Vec3 ship(-e.velocity.y(), e.velocity.x(), e.velocity.z());  // to starboard, ahead, up
  for (Eigen::Index i = 0; i < 3; ++i) {
    text += ',';
    append_signed(text, e.valid ? 1e3 * ship[i] : -32768.0, 5, 0);
  }
  text.append(e.valid ? ",A\r\n:BD" : ",V\r\n:BD");
  for (int i = 0; i < 3; ++i) {
    text += ',';
    append_signed(text, 0.0, 8, 2);
  }
  text += ',';
  append_plain(text, e.altitude.value_or(0.0), 4, 2);
  text += ',';
  append_plain(text, e.age, 3, 2);
  return text.append("\r\n");
}

bool read_pd6_line(std::string_view line, Pd6Ensemble& ensemble) {
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n')) line.remove_suffix(1);
  const auto fields = fields_of(line);
  if (fields[0] == ":SA") {
    need(fields, 4);
    ensemble.pitch = number(fields[1]);
    ensemble.roll = number(fields[2]);
    ensemble.heading = number(fields[3]);
  } else if (fields[0] == ":TS") {
    need(fields, 7);
    read_stamp(fields[1], ensemble);
    ensemble.depth = number(fields[4]);
    ensemble.sound_speed = number(fields[5]);
  } else if (fields[0] == ":BS") {
    need(fields, 5);
    ensemble.valid = fields[4] == "A";
    const Vec3 ship(number(fields[1]), number(fields[2]), number(fields[3]));
    if (ensemble.valid) ensemble.velocity = 1e-3 * Vec3(ship.y(), -ship.x(), ship.z());
  } else if (fields[0] == ":BD") {
    need(fields, 6);
    const double altitude = number(fields[4]);
    ensemble.altitude = altitude > 0.0 ? std::optional<double>(altitude) : std::nullopt;
    ensemble.age = number(fields[5]);
  } else {
    return false;
  }
  return true;
}

}  // namespace bathyal
