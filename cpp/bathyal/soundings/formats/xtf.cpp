// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/formats/xtf.hpp"

#include <algorithm>
#include <cstring>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

constexpr std::size_t kFileHeader = 1024;
constexpr std::size_t kPingHeader = 256;
constexpr std::size_t kChannelHeader = 64;
constexpr std::size_t kPacketHeader = 14;
constexpr std::size_t kFirstChannel = 256;  ///< of the descriptions in the file's header
constexpr std::size_t kDescription = 128;
constexpr std::uint8_t kFileMark = 123;
constexpr std::uint16_t kPacketMark = 0xFACE;
constexpr int kSonarPing = 0;

using Bytes = std::span<const std::uint8_t>;

template <class Number>
Number number_at(Bytes bytes, std::size_t offset) {
  Number value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::size_t described(int channel, std::size_t offset) {
  if (channel < 0 || channel >= static_cast<int>(kXtfChannels)) {
    throw_argument("channel", "one of the six that a file describes", std::to_string(channel));
  }
  return kFirstChannel + static_cast<std::size_t>(channel) * kDescription + offset;
}

/// The file's header: 1,024 bytes, and as many again for each six channels beyond the first six.
std::size_t header_size(Bytes bytes) {
  const std::size_t channels =
      number_at<std::uint16_t>(bytes, 166) + number_at<std::uint16_t>(bytes, 168);
  return kFileHeader * std::max<std::size_t>(1, (channels + kXtfChannels - 1) / kXtfChannels);
}

bool marked(Bytes bytes, std::size_t at) {
  return at + 2 <= bytes.size() && number_at<std::uint16_t>(bytes, at) == kPacketMark;
}

/// Whether a whole packet lies here.
bool is_packet(Bytes bytes, std::size_t at) {
  if (bytes.size() - at < kPacketHeader || !marked(bytes, at)) return false;
  const std::size_t size = number_at<std::uint32_t>(bytes, at + 10);
  return size >= kPacketHeader && size <= bytes.size() - at;
}

/// Where packets go on after bytes that are none, or the end. A mark may occur in samples by
/// chance: what follows the packet must be one, too, or the end.
std::size_t next_packet(Bytes bytes, std::size_t from) {
  for (; from + kPacketHeader <= bytes.size(); ++from) {
    if (!is_packet(bytes, from)) continue;
    const std::size_t end = from + number_at<std::uint32_t>(bytes, from + 10);
    if (end == bytes.size() || marked(bytes, end)) return from;
  }
  return bytes.size();
}

/// The channels of a ping's record; false where its sizes contradict each other.
bool read_channels(const XtfFile& file, Bytes record, XtfPacket& ping) {
  std::copy_n(record.begin(), kPingHeader, ping.header.bytes.begin());
  const int count = number_at<std::uint16_t>(record, 4);
  std::size_t at = kPingHeader;
  for (int i = 0; i < count; ++i) {
    if (record.size() - at < kChannelHeader) return false;
    XtfChannel channel;
    std::copy_n(record.begin() + static_cast<std::ptrdiff_t>(at), kChannelHeader,
                channel.header.bytes.begin());
    at += kChannelHeader;
    if (channel.number() >= static_cast<int>(kXtfChannels)) return false;
    const auto samples = static_cast<std::uint64_t>(channel.sample_count());
    const auto size = static_cast<std::uint64_t>(file.bytes_per_sample(channel.number()));
    if (size == 0 || samples > (record.size() - at) / size) return false;
    const auto begin = record.begin() + static_cast<std::ptrdiff_t>(at);
    channel.samples.assign(begin, begin + static_cast<std::ptrdiff_t>(samples * size));
    at += samples * size;
    ping.channels.push_back(std::move(channel));
  }
  ping.rest.assign(record.begin() + static_cast<std::ptrdiff_t>(at), record.end());
  ping.is_ping = true;
  return true;
}

void append(std::vector<std::uint8_t>& bytes, Bytes more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

template <class Number>
std::vector<double> numbers_of(const std::vector<std::uint8_t>& bytes) {
  std::vector<double> values(bytes.size() / sizeof(Number));
  for (std::size_t i = 0; i < values.size(); ++i) {
    Number value;
    std::memcpy(&value, bytes.data() + i * sizeof value, sizeof value);
    values[i] = static_cast<double>(value);
  }
  return values;
}

}  // namespace

std::int64_t XtfFile::ping_count() const {
  return std::count_if(packets.begin(), packets.end(),
                       [](const XtfPacket& packet) { return packet.is_ping; });
}

int XtfFile::channel_type(int channel) const {
  return header.get<std::uint8_t>(described(channel, 0));
}

bool XtfFile::unipolar(int channel) const {
  return header.get<std::uint16_t>(described(channel, 4)) != 0;
}

int XtfFile::bytes_per_sample(int channel) const {
  return header.get<std::uint16_t>(described(channel, 6));
}

std::string XtfFile::channel_name(int channel) const {
  const auto* text = reinterpret_cast<const char*>(header.bytes.data()) + described(channel, 12);
  return {text, strnlen(text, 16)};
}

double XtfFile::frequency(int channel) const {
  return 1e3 * header.get<float>(described(channel, 32));
}

int XtfFile::sample_format(int channel) const {
  return header.get<std::uint8_t>(described(channel, 74));
}

XtfFile parse_xtf(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kFileHeader || bytes[0] != kFileMark) {
    throw Error("not an XTF file: expected a header of 1,024 bytes that begins with 123");
  }
  XtfFile file;
  std::copy_n(bytes.begin(), kFileHeader, file.header.bytes.begin());
  const std::size_t first = header_size(bytes);
  if (first > kFileHeader) {
    throw Error("XTF: files that describe more than six channels are not read");
  }
  for (std::size_t at = first; at < bytes.size();) {
    if (!is_packet(bytes, at)) {
      if (marked(bytes, at)) ++file.damaged;
      const std::size_t next = next_packet(bytes, at + 1);
      file.lost_bytes += static_cast<std::int64_t>(next - at);
      at = next;
      continue;
    }
    const std::size_t size = number_at<std::uint32_t>(bytes, at + 10);
    const Bytes record = bytes.subspan(at, size);
    XtfPacket packet;
    if (record[2] != kSonarPing) {
      ++file.other_packets[record[2]];
      packet.rest.assign(record.begin(), record.end());
      file.packets.push_back(std::move(packet));
    } else if (size >= kPingHeader && read_channels(file, record, packet)) {
      file.packets.push_back(std::move(packet));
    } else {
      ++file.damaged;
      file.lost_bytes += static_cast<std::int64_t>(size);
    }
    at += size;
  }
  return file;
}

std::vector<std::uint8_t> format_xtf(const XtfFile& file) {
  std::vector<std::uint8_t> bytes(file.header.bytes.begin(), file.header.bytes.end());
  for (const XtfPacket& packet : file.packets) {
    if (packet.is_ping) {
      append(bytes, packet.header.bytes);
      for (const XtfChannel& channel : packet.channels) {
        append(bytes, channel.header.bytes);
        append(bytes, channel.samples);
      }
    }
    append(bytes, packet.rest);
  }
  return bytes;
}

std::vector<double> xtf_samples(const XtfFile& file, const XtfChannel& channel) {
  constexpr int kFloat = 5;
  const int number = channel.number();
  const bool positive = file.unipolar(number);
  switch (file.bytes_per_sample(number)) {
    case 1:
      return positive ? numbers_of<std::uint8_t>(channel.samples)
                      : numbers_of<std::int8_t>(channel.samples);
    case 2:
      return positive ? numbers_of<std::uint16_t>(channel.samples)
                      : numbers_of<std::int16_t>(channel.samples);
    case 4:
      if (file.sample_format(number) == kFloat) return numbers_of<float>(channel.samples);
      return positive ? numbers_of<std::uint32_t>(channel.samples)
                      : numbers_of<std::int32_t>(channel.samples);
    default:
      throw Error("XTF: samples of " + std::to_string(file.bytes_per_sample(number)) +
                  " bytes are not read");
  }
}

}  // namespace bathyal
