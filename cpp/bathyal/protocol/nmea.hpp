// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace bathyal {

// NMEA 0183: lines of text "$TALKER,field,…*hh", hh the exclusive or of what lies between.

/// A whole sentence, checksum and line end included.
/// \param body "GPGGA,…": printable ASCII without $ ! * \ ^ ~
/// \throw std::invalid_argument for other characters, or none
std::string nmea_sentence(std::string_view body);

/// A position as GGA and RMC give it.
struct NmeaFix {
  double time = 0.0;       ///< UTC, of the day [s], 0 to 86 400
  int day = 1, month = 1;  ///< of the date
  int year = 2000;         ///< 2000 to 2099
  double latitude = 0.0;   ///< [deg], −90 to 90
  double longitude = 0.0;  ///< [deg], −180 to 180
  double altitude = 0.0;   ///< above the mean sea [m]
  double speed = 0.0;      ///< over ground [m/s]
  double course = 0.0;     ///< from north to east [deg], 0 to 360
  int satellites = 9;
  double dilution = 0.9;  ///< horizontal
  bool valid = true;

  /// \throw std::invalid_argument that names the field
  void check() const;
};

/// Minutes with five decimals: 1.9 cm of latitude. \throw std::invalid_argument as NmeaFix::check
std::string nmea_gga(const NmeaFix& fix);
std::string nmea_rmc(const NmeaFix& fix);
/// \param heading true [deg] \throw std::invalid_argument unless finite
std::string nmea_hdt(double heading);
/// \param depth of water below the transducer [m] \throw std::invalid_argument unless 0 or more
std::string nmea_dpt(double depth);
/// \param ahead, port speeds over ground [m/s] \param valid whether they are
std::string nmea_vbw(double ahead, double port, bool valid);

/// A number as short as it comes back the same; empty for one that is not finite.
void append_number(std::string& text, double value);

/// What a stream's reader has met.
struct NmeaCounts {
  std::uint64_t bytes = 0, sentences = 0;
  std::uint64_t wrong_checksum = 0;  ///< sentences with another checksum, or none
  std::uint64_t broken = 0;          ///< lines that begin anew, are too long or hold other bytes
};

/// Cuts a stream of bytes into sentences; what is none is counted and skipped.
class NmeaReader {
 public:
  static constexpr std::size_t kLongest = 1024;

  /// \param body called with each sentence's, "GPGGA,…"
  void feed(std::string_view bytes, const std::function<void(std::string_view)>& body);

  const NmeaCounts& counts() const { return counts_; }

 private:
  void finish(const std::function<void(std::string_view)>& body);

  std::string line_;  ///< since its $; empty: between sentences
  NmeaCounts counts_;
};

/// A position of a body of GGA. \throw Error for another, or for fields that are none
NmeaFix read_gga(std::string_view body);

}  // namespace bathyal
