// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/formats/sidescan.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <numbers>
#include <utility>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kPort = 1, kStarboard = 2;
constexpr int kGeographic = 3;  ///< navigation units
constexpr const char* kStepNote = "amplitude of a step ";

/// The file's channels that are taken as rows: the first port, the first starboard.
std::vector<int> row_channels(const XtfFile& file, std::vector<std::string>& names) {
  std::vector<int> channels;
  for (const auto& [type, name] : {std::pair{kPort, "port"}, {kStarboard, "starboard"}}) {
    for (int channel = 0; channel < static_cast<int>(kXtfChannels); ++channel) {
      if (file.channel_type(channel) != type || file.bytes_per_sample(channel) == 0) continue;
      channels.push_back(channel);
      names.emplace_back(name);
      break;
    }
  }
  return channels;
}

double time_of(const XtfHeader<256>& header) {
  using std::chrono::day, std::chrono::month, std::chrono::year;
  const std::chrono::year_month_day date{year(header.get<std::uint16_t>(14)),
                                         month(header.get<std::uint8_t>(16)),
                                         day(header.get<std::uint8_t>(17))};
  if (!date.ok()) return kNone;
  const auto days = static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
  return 86400.0 * days + 3600.0 * header.get<std::uint8_t>(18) +
         60.0 * header.get<std::uint8_t>(19) + header.get<std::uint8_t>(20) +
         0.01 * header.get<std::uint8_t>(21);
}

void set_time(XtfHeader<256>& header, double time) {
  const auto hundredths = static_cast<std::int64_t>(std::llround(100.0 * time));
  const std::int64_t per_day = 8640000;
  const std::int64_t days = (hundredths >= 0 ? hundredths : hundredths - per_day + 1) / per_day;
  const std::int64_t left = hundredths - days * per_day;
  const std::chrono::sys_days when{std::chrono::days(days)};
  const std::chrono::year_month_day date(when);
  const std::chrono::sys_days new_year(date.year() / std::chrono::January / 1);
  header.set<std::uint16_t>(14, static_cast<std::uint16_t>(static_cast<int>(date.year())));
  header.set<std::uint8_t>(16, static_cast<std::uint8_t>(static_cast<unsigned>(date.month())));
  header.set<std::uint8_t>(17, static_cast<std::uint8_t>(static_cast<unsigned>(date.day())));
  header.set<std::uint8_t>(18, static_cast<std::uint8_t>(left / 360000));
  header.set<std::uint8_t>(19, static_cast<std::uint8_t>(left / 6000 % 60));
  header.set<std::uint8_t>(20, static_cast<std::uint8_t>(left / 100 % 60));
  header.set<std::uint8_t>(21, static_cast<std::uint8_t>(left % 100));
  header.set<std::uint16_t>(22, static_cast<std::uint16_t>((when - new_year).count() + 1));
}

void add_navigation(const XtfHeader<256>& header, SidescanPings& pings) {
  const double y = header.get<double>(160), x = header.get<double>(168);
  // A ping without navigation is all zeros; the origin of a grid is a place, 0° N 0° E none.
  const bool elsewhere = header.get<float>(196) != 0.0F || header.get<float>(212) != 0.0F;
  const bool known = std::isfinite(x) && std::isfinite(y) &&
                     (x != 0.0 || y != 0.0 || (!pings.geographic && elsewhere));
  const double unit = pings.geographic ? kDegree : 1.0;
  pings.x.push_back(known ? unit * x : kNone);
  pings.y.push_back(known ? unit * y : kNone);
  const auto value = [&](std::size_t offset) -> double {
    const double read = header.get<float>(offset);
    return known && std::isfinite(read) ? read : kNone;
  };
  pings.speed.push_back(0.514444 * value(152));  // knots
  pings.depth.push_back(value(192));
  pings.altitude.push_back(value(196));
  pings.pitch.push_back(kDegree * value(204));
  pings.roll.push_back(kDegree * value(208));
  pings.heading.push_back(kDegree * value(212));
  pings.sound_speed.push_back(2.0 * static_cast<double>(header.get<float>(32)));  // stored one-way
  pings.number.push_back(header.get<std::uint32_t>(28));
}

void add_row(const XtfFile& file, const XtfPacket& packet, int number, std::size_t samples,
             SidescanPings& pings) {
  std::vector<float> row(samples, std::numeric_limits<float>::quiet_NaN());
  double range = kNone;
  for (const XtfChannel& channel : packet.channels) {
    if (channel.number() != number) continue;
    std::vector<double> values = xtf_samples(file, channel);
    if (file.channel_type(number) == kPort) std::reverse(values.begin(), values.end());
    std::transform(values.begin(), values.end(), row.begin(), [&](double value) {
      return static_cast<float>(pings.amplitude_step * std::abs(value));
    });
    range = channel.slant_range();
    break;
  }
  pings.amplitude.insert(pings.amplitude.end(), row.begin(), row.end());
  pings.slant_range.push_back(range);
}

std::string text_at(const XtfHeader<1024>& header, std::size_t offset, std::size_t size) {
  const auto* text = reinterpret_cast<const char*>(header.bytes.data()) + offset;
  return {text, strnlen(text, size)};
}

template <std::size_t Size>
void set_text(XtfHeader<Size>& header, std::size_t offset, std::size_t size,
              const std::string& text) {
  std::memcpy(header.bytes.data() + offset, text.data(), std::min(size - 1, text.size()));
}

/// What a step means, in the note of a file that was written here.
double step_of(const XtfFile& file) {
  const std::string note = text_at(file.header, 36, 64);
  if (note.rfind(kStepNote, 0) != 0) return 1.0;
  const double step = std::strtod(note.c_str() + std::strlen(kStepNote), nullptr);
  return step > 0.0 && std::isfinite(step) ? step : 1.0;
}

void check_pings(const SidescanPings& pings) {
  const auto count = pings.count();
  const auto rows = static_cast<std::size_t>(pings.rows());
  if (rows < 1 || rows > 2) throw_argument("beam_names", "port, starboard or both", "others");
  if (pings.amplitude.size() != count * rows * static_cast<std::size_t>(pings.samples) ||
      pings.slant_range.size() != count * rows) {
    throw_argument("amplitude", "as many rows as pings and beams", "others");
  }
  for (const auto* column : {&pings.x, &pings.y, &pings.depth, &pings.altitude, &pings.heading,
                             &pings.pitch, &pings.roll, &pings.speed, &pings.sound_speed}) {
    if (column->size() != count) throw_argument("navigation", "a row for each ping", "others");
  }
  for (const float value : pings.amplitude) {
    if (value < 0.0F || std::isinf(value)) {
      throw_argument("amplitude", "finite values of 0 or more", to_text(value));
    }
  }
}

XtfHeader<1024> file_header(const SidescanPings& pings, double step) {
  XtfHeader<1024> header;
  header.set<std::uint8_t>(0, 123);
  header.set<std::uint8_t>(1, 1);
  set_text(header, 2, 8, "bathyal");
  set_text(header, 18, 16, pings.sonar_name);
  char note[64];
  std::snprintf(note, sizeof note, "%s%.9g", kStepNote, step);
  set_text(header, 36, 64, note);
  header.set<std::uint16_t>(164, pings.geographic ? kGeographic : 0);
  header.set<std::uint16_t>(166, static_cast<std::uint16_t>(pings.rows()));
  for (std::size_t row = 0; row < static_cast<std::size_t>(pings.rows()); ++row) {
    const std::size_t at = 256 + 128 * row;
    const bool port = pings.beam_names[row] == "port";
    header.set<std::uint8_t>(at, static_cast<std::uint8_t>(port ? kPort : kStarboard));
    header.set<std::uint8_t>(at + 1, static_cast<std::uint8_t>(row));
    header.set<std::uint16_t>(at + 2, 1);  // slant range
    header.set<std::uint16_t>(at + 4, 1);  // unipolar
    header.set<std::uint16_t>(at + 6, 2);  // bytes a sample
    header.set<std::uint32_t>(at + 8, static_cast<std::uint32_t>(pings.samples));
    set_text(header, at + 12, 16, port ? "PORT" : "STARBOARD");
    header.set<float>(at + 28, 5.0F);
    header.set<float>(at + 32, static_cast<float>(1e-3 * pings.frequency));
    header.set<std::uint8_t>(at + 74, 3);  // 16 bits
  }
  return header;
}

XtfHeader<256> ping_header(const SidescanPings& pings, std::size_t k) {
  XtfHeader<256> header;
  header.set<std::uint16_t>(0, 0xFACE);
  header.set<std::uint16_t>(4, static_cast<std::uint16_t>(pings.rows()));
  set_time(header, pings.time[k]);
  header.set<std::uint32_t>(28, static_cast<std::uint32_t>(pings.number[k]));
  header.set<float>(32, static_cast<float>(0.5 * pings.sound_speed[k]));
  const double unit = pings.geographic ? 1.0 / kDegree : 1.0;
  const bool known = std::isfinite(pings.x[k]) && std::isfinite(pings.y[k]);
  const auto number = [&](double value) { return std::isfinite(value) ? value : 0.0; };
  for (const std::size_t at : {std::size_t{128}, std::size_t{160}}) {  // ship, sensor
    header.set<double>(at, known ? unit * pings.y[k] : 0.0);
    header.set<double>(at + 8, known ? unit * pings.x[k] : 0.0);
  }
  const auto degrees = [&](double value) { return static_cast<float>(number(value) / kDegree); };
  const auto speed = static_cast<float>(number(pings.speed[k]) / 0.514444);
  header.set<float>(120, speed);
  header.set<float>(124, degrees(pings.heading[k]));
  header.set<float>(152, speed);
  header.set<float>(192, static_cast<float>(number(pings.depth[k])));
  header.set<float>(196, static_cast<float>(number(pings.altitude[k])));
  header.set<float>(204, degrees(pings.pitch[k]));
  header.set<float>(208, degrees(pings.roll[k]));
  header.set<float>(212, degrees(pings.heading[k]));
  return header;
}

XtfChannel channel_of(const SidescanPings& pings, std::size_t k, std::size_t row, double step) {
  const auto rows = static_cast<std::size_t>(pings.rows());
  const auto samples = static_cast<std::size_t>(pings.samples);
  const float* amplitude = pings.amplitude.data() + (k * rows + row) * samples;
  XtfChannel channel;
  channel.header.set<std::uint16_t>(0, static_cast<std::uint16_t>(row));
  channel.header.set<std::uint16_t>(2, 2);
  const double range = pings.slant_range[k * rows + row];
  const double duration = 2.0 * range / pings.sound_speed[k];
  channel.header.set<float>(4, static_cast<float>(range));
  channel.header.set<float>(16, static_cast<float>(duration));
  channel.header.set<float>(20, static_cast<float>(duration));
  channel.header.set<std::uint16_t>(26, static_cast<std::uint16_t>(1e-3 * pings.frequency));
  channel.header.set<std::uint32_t>(42, static_cast<std::uint32_t>(samples));
  channel.samples.resize(2 * samples);
  const bool port = pings.beam_names[row] == "port";
  for (std::size_t i = 0; i < samples; ++i) {
    const float value = amplitude[port ? samples - 1 - i : i];
    const double steps = std::isnan(value) ? 0.0 : std::round(static_cast<double>(value) / step);
    const auto stored = static_cast<std::uint16_t>(std::min(steps, 65535.0));
    std::memcpy(channel.samples.data() + 2 * i, &stored, 2);
  }
  return channel;
}

}  // namespace

SidescanPings sidescan_of(const XtfFile& file) {
  SidescanPings pings;
  const std::vector<int> channels = row_channels(file, pings.beam_names);
  if (channels.empty()) throw Error("XTF: no side-scan channel, port or starboard");
  pings.geographic = file.header.get<std::uint16_t>(164) == kGeographic;
  pings.frequency = file.frequency(channels.front());
  pings.amplitude_step = step_of(file);
  pings.sonar_name = text_at(file.header, 18, 16);
  std::int64_t stored = 0;
  for (const XtfPacket& packet : file.packets) {
    for (const XtfChannel& channel : packet.channels) {
      if (std::find(channels.begin(), channels.end(), channel.number()) == channels.end()) continue;
      pings.samples = std::max(pings.samples, channel.sample_count());
      stored += channel.sample_count();
    }
  }
  constexpr std::int64_t kPadding = 16, kAlways = 1 << 20;
  if (pings.samples * pings.rows() * file.ping_count() > kPadding * stored + kAlways) {
    throw Error("XTF: rows too unlike in length to be one array");
  }
  for (const XtfPacket& packet : file.packets) {
    if (!packet.is_ping) continue;
    pings.time.push_back(time_of(packet.header));
    add_navigation(packet.header, pings);
    for (const int channel : channels) {
      add_row(file, packet, channel, static_cast<std::size_t>(pings.samples), pings);
    }
  }
  return pings;
}

XtfFile xtf_of(const SidescanPings& pings) {
  check_pings(pings);
  double step = pings.amplitude_step;
  if (!(step > 0.0)) {
    float largest = 0.0F;
    for (const float value : pings.amplitude) {
      if (value > largest) largest = value;
    }
    step = largest > 0.0F ? static_cast<double>(largest) / 65535.0 : 1.0;
  }
  XtfFile file;
  file.header = file_header(pings, step);
  for (std::size_t k = 0; k < pings.count(); ++k) {
    XtfPacket packet;
    packet.is_ping = true;
    packet.header = ping_header(pings, k);
    std::size_t size = 256;
    for (std::size_t row = 0; row < static_cast<std::size_t>(pings.rows()); ++row) {
      packet.channels.push_back(channel_of(pings, k, row, step));
      size += 64 + packet.channels.back().samples.size();
    }
    packet.rest.resize((64 - size % 64) % 64);
    packet.header.set<std::uint32_t>(10, static_cast<std::uint32_t>(size + packet.rest.size()));
    file.packets.push_back(std::move(packet));
  }
  return file;
}

}  // namespace bathyal
