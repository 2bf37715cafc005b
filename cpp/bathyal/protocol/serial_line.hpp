// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace bathyal {

struct SerialLineOptions {
  std::string name = "line";    ///< keys the bit errors
  double baud = 4800.0;         ///< bits a second, above 0; a byte takes ten (8N1)
  std::size_t buffer = 4096;    ///< bytes that wait at most, above 0
  double bit_error_rate = 0.0;  ///< part of the bits that arrive turned, 0 to 1

  /// \throw std::invalid_argument that names the field
  void check() const;
};

struct SerialLineState {
  std::string waiting;        ///< bytes
  double credit = 0.0;        ///< bytes that the line could have carried, and did not
  std::uint64_t carried = 0;  ///< bytes
  std::uint64_t lost = 0;     ///< bytes, to overrun
  std::uint64_t turned = 0;   ///< bits
};

/// What arrives of a serial line in some time. Bytes that find the buffer full are lost, so that
/// lines are cut; what arrives is handed on in whole lines, as a receiver reads them.
/// \param given bytes that are sent now \param duration since the last call [s]
/// \return the bytes that arrive
std::string carry(const SerialLineOptions& options, SerialLineState& state, std::string_view given,
                  double duration, std::uint64_t seed);

}  // namespace bathyal
