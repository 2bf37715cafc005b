// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace bathyal {

// XTF, the eXtended Triton Format of side-scan records (Triton Imaging, XTF file format, revision
// 42). Bytes in, bytes out; numbers are little-endian. Headers are kept whole, so that what is read
// and written again is the same to the last byte.

/// Bytes of a header, and its numbers by their offset.
template <std::size_t Size>
struct XtfHeader {
  std::array<std::uint8_t, Size> bytes{};

  template <class Number>
  Number get(std::size_t offset) const {
    Number value;
    __builtin_memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
  }
  template <class Number>
  void set(std::size_t offset, Number value) {
    __builtin_memcpy(bytes.data() + offset, &value, sizeof value);
  }
};

inline constexpr std::size_t kXtfChannels = 6;  ///< that the file's header describes

/// One channel of a ping.
struct XtfChannel {
  XtfHeader<64> header;
  std::vector<std::uint8_t> samples;  ///< as in the file

  int number() const { return header.get<std::uint16_t>(0); }  ///< counts the file's channels
  double slant_range() const { return header.get<float>(4); }  ///< [m]
  std::int64_t sample_count() const { return header.get<std::uint32_t>(42); }
};

/// A packet: a sonar ping, or anything else, which is kept as it is.
struct XtfPacket {
  XtfHeader<256> header;             ///< of a ping
  std::vector<XtfChannel> channels;  ///< of a ping
  std::vector<std::uint8_t> rest;    ///< what fills a ping's record; all of any other packet
  bool is_ping = false;
};

struct XtfFile {
  XtfHeader<1024> header;
  std::vector<XtfPacket> packets;

  // What the reader met.
  std::map<int, std::int64_t> other_packets;  ///< how many of each type that is no sonar ping
  std::int64_t damaged = 0;                   ///< packets whose sizes contradict each other
  std::int64_t lost_bytes = 0;                ///< outside of any packet, or in a damaged one

  std::int64_t ping_count() const;

  // Of channel `channel` of the file.
  int channel_type(int channel) const;  ///< 0 sub-bottom, 1 port, 2 starboard, 3 bathymetry
  int bytes_per_sample(int channel) const;
  int sample_format(
      int channel) const;  ///< 1 IBM float, 2 int32, 3 int16, 5 float, 8 byte; 0: by size
  bool unipolar(int channel) const;
  std::string channel_name(int channel) const;
  double frequency(int channel) const;  ///< [Hz]
};

/// Reads all whole packets; what is broken is left out and counted.
/// \throw Error for what does not begin as an XTF file.
XtfFile parse_xtf(std::span<const std::uint8_t> bytes);

/// The bytes of a file. \throw std::invalid_argument for a packet of more than 4 GB.
std::vector<std::uint8_t> format_xtf(const XtfFile& file);

/// The samples of a channel as numbers, in the order in which they are stored.
std::vector<double> xtf_samples(const XtfFile& file, const XtfChannel& channel);

}  // namespace bathyal
