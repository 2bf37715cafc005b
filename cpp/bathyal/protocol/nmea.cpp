// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/protocol/nmea.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "bathyal/base/error.hpp"
#include "bathyal/protocol/internal/fields.hpp"

namespace bathyal {
namespace {

constexpr double kKnots = 3600.0 / 1852.0;  // of a metre per second
constexpr int kMinuteParts = 100'000;       // five decimals

bool allowed(char c) {
  return c >= 0x20 && c < 0x7f && std::string_view("$!*\\^~").find(c) == std::string_view::npos;
}

std::uint8_t checksum(std::string_view body) {
  std::uint8_t sum = 0;
  for (const char c : body) sum = static_cast<std::uint8_t>(sum ^ static_cast<std::uint8_t>(c));
  return sum;
}

void append_fixed(std::string& text, double value, int decimals) {
  std::array<char, 64> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::fixed, decimals);
  text.append(digits.data(), end.ptr);
}

void append_padded(std::string& text, std::int64_t value, std::size_t width) {
  const std::string digits = std::to_string(value);
  text.append(width > digits.size() ? width - digits.size() : 0, '0').append(digits);
}

/// "hhmmss.sss"
void append_time(std::string& text, double time) {
  const auto thousandths = static_cast<std::int64_t>(std::llround(time * 1e3)) % 86'400'000;
  append_padded(text, thousandths / 3'600'000, 2);
  append_padded(text, thousandths / 60'000 % 60, 2);
  append_padded(text, thousandths / 1000 % 60, 2);
  text += '.';
  append_padded(text, thousandths % 1000, 3);
}

/// "ddmm.mmmmm,N"
void append_angle(std::string& text, double degrees, std::size_t width, const char* sides) {
  const std::int64_t parts = std::llround(std::abs(degrees) * 60.0 * kMinuteParts);
  append_padded(text, parts / (60 * kMinuteParts), width);
  append_padded(text, parts / kMinuteParts % 60, 2);
  text += '.';
  append_padded(text, parts % kMinuteParts, 5);
  text += ',';
  text += sides[degrees < 0.0 ? 1 : 0];
}

void append_place(std::string& text, const NmeaFix& fix) {
  append_angle(text, fix.latitude, 2, "NS");
  text += ',';
  append_angle(text, fix.longitude, 3, "EW");
}

double angle_of(std::string_view field, std::string_view side, const char* sides, double most) {
  const double packed = number_of("GGA", field, 0.0, most * 100.0);
  const double degrees = std::floor(packed / 100.0);
  const double found = degrees + (packed - 100.0 * degrees) / 60.0;
  const bool known = side.size() == 1 && (side[0] == sides[0] || side[0] == sides[1]);
  if (!known || packed - 100.0 * degrees >= 60.0 || found > most) {
    throw_field("GGA", "an angle", field);
  }
  return side[0] == sides[0] ? found : -found;
}

}  // namespace

void append_number(std::string& text, double value) {
  if (!std::isfinite(value)) return;
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end.ptr);
}

std::string nmea_sentence(std::string_view body) {
  if (body.empty() || !std::all_of(body.begin(), body.end(), allowed)) {
    throw_argument("body", "printable ASCII without $ ! * \\ ^ ~", std::string(body.substr(0, 60)));
  }
  constexpr std::string_view kHex = "0123456789ABCDEF";
  const std::uint8_t sum = checksum(body);
  std::string text("$");
  text.append(body).append("*");
  text.append(kHex.substr(sum >> 4U, 1)).append(kHex.substr(sum & 15U, 1)).append("\r\n");
  return text;
}

void NmeaFix::check() const {
  check_range("time", time, 0.0, 86'400.0);
  check_range("day", day, 1, 31);
  check_range("month", month, 1, 12);
  check_range("year", year, 2000, 2099);
  check_range("latitude", latitude, -90.0, 90.0);
  check_range("longitude", longitude, -180.0, 180.0);
  check_range("altitude", altitude, -20'000.0, 20'000.0);
  check_range("speed", speed, 0.0, 1e4);
  check_range("course", course, 0.0, 360.0);
  check_range("satellites", satellites, 0, 99);
  check_range("dilution", dilution, 0.0, 99.9);
}

std::string nmea_gga(const NmeaFix& fix) {
  fix.check();
  std::string body("GPGGA,");
  append_time(body, fix.time);
  body += ',';
  if (fix.valid) {
    append_place(body, fix);
    body.append(",1,");
    append_padded(body, fix.satellites, 2);
    body += ',';
    append_fixed(body, fix.dilution, 1);
    body += ',';
    append_fixed(body, fix.altitude, 3);
    body.append(",M,0.0,M,,");
  } else {
    body.append(",,,,0,00,,,M,,M,,");
  }
  return nmea_sentence(body);
}

std::string nmea_rmc(const NmeaFix& fix) {
  fix.check();
  std::string body("GPRMC,");
  append_time(body, fix.time);
  if (fix.valid) {
    body.append(",A,");
    append_place(body, fix);
    body += ',';
    append_fixed(body, fix.speed * kKnots, 3);
    body += ',';
    append_fixed(body, fix.course, 2);
  } else {
    body.append(",V,,,,,,");
  }
  body += ',';
  append_padded(body, fix.day, 2);
  append_padded(body, fix.month, 2);
  append_padded(body, fix.year % 100, 2);
  body.append(fix.valid ? ",,,A" : ",,,N");
  return nmea_sentence(body);
}

std::string nmea_hdt(double heading) {
  if (!std::isfinite(heading)) throw_argument("heading", "a finite angle", to_text(heading));
  std::string body("HEHDT,");
  double turned = std::fmod(heading, 360.0);
  if (turned < 0.0) turned += 360.0;
  append_fixed(body, turned >= 359.995 ? 0.0 : turned, 2);
  return nmea_sentence(body.append(",T"));
}

std::string nmea_dpt(double depth) {
  check_range("depth", depth, 0.0, 20'000.0);
  std::string body("SDDPT,");
  append_fixed(body, depth, 3);
  return nmea_sentence(body.append(",0.0"));
}

std::string nmea_vbw(double ahead, double port, bool valid) {
  std::string body("VDVBW,,,V,");
  if (valid) {
    check_range("ahead", ahead, -1e4, 1e4);
    check_range("port", port, -1e4, 1e4);
    append_fixed(body, ahead * kKnots, 3);
    body += ',';
    append_fixed(body, -port * kKnots, 3);  // to starboard
    body.append(",A");
  } else {
    body.append(",,V");
  }
  return nmea_sentence(body);
}

void NmeaReader::feed(std::string_view bytes, const std::function<void(std::string_view)>& body) {
  counts_.bytes += bytes.size();
  for (const char c : bytes) {
    if (c == '$') {
      if (!line_.empty()) ++counts_.broken;
      line_.assign(1, c);
    } else if (line_.empty()) {
      continue;
    } else if (c == '\r' || c == '\n') {
      finish(body);
    } else if (line_.size() >= kLongest || (c != '*' && !allowed(c))) {
      ++counts_.broken;
      line_.clear();
    } else {
      line_ += c;
    }
  }
}

void NmeaReader::finish(const std::function<void(std::string_view)>& body) {
  const std::string_view line(line_);
  const std::size_t star = line.find('*');
  unsigned given = 256;
  std::string_view inner;
  if (star != std::string_view::npos && line.size() == star + 3) {
    const char* end = line.data() + line.size();
    if (std::from_chars(line.data() + star + 1, end, given, 16).ptr != end) given = 256;
    inner = line.substr(1, star - 1);
  }
  if (!inner.empty() && given == checksum(inner)) {
    ++counts_.sentences;
    body(inner);
  } else {
    ++counts_.wrong_checksum;
  }
  line_.clear();
}

NmeaFix read_gga(std::string_view body) {
  const auto fields = fields_of(body);
  const bool is_gga = fields[0].size() == 5 && fields[0].substr(2) == "GGA";
  if (!is_gga || fields.size() < 15) {
    throw_field("GGA", "15 fields", body);
  }
  NmeaFix fix;
  const double packed = number_of("GGA", fields[1], 0.0, 240'000.0);
  const double hours = std::floor(packed / 1e4),
               minutes = std::floor(packed / 100.0) - 100.0 * hours;
  fix.time = 3600.0 * hours + 60.0 * minutes + (packed - 1e4 * hours - 100.0 * minutes);
  fix.valid = fields[6] != "0" && !fields[6].empty();
  if (!fix.valid) return fix;
  fix.latitude = angle_of(fields[2], fields[3], "NS", 90.0);
  fix.longitude = angle_of(fields[4], fields[5], "EW", 180.0);
  fix.satellites = static_cast<int>(number_of("GGA", fields[7], 0.0, 99.0));
  fix.dilution = number_of("GGA", fields[8], 0.0, 99.9);
  fix.altitude = number_of("GGA", fields[9], -20'000.0, 20'000.0);
  return fix;
}

}  // namespace bathyal
