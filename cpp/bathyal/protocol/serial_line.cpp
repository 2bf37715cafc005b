// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/protocol/serial_line.hpp"

#include <algorithm>
#include <cmath>

#include "bathyal/base/error.hpp"
#include "bathyal/base/random.hpp"

namespace bathyal {
namespace {

constexpr double kBitsPerByte = 10.0;

}  // namespace

void SerialLineOptions::check() const {
  if (!(baud > 0.0 && std::isfinite(baud))) throw_argument("baud", "above 0", to_text(baud));
  if (buffer == 0) throw_argument("buffer", "1 byte or more", "0");
  if (!(bit_error_rate >= 0.0 && bit_error_rate <= 1.0)) {
    throw_argument("bit_error_rate", "from 0 to 1", to_text(bit_error_rate));
  }
}

std::string carry(const SerialLineOptions& options, SerialLineState& state, std::string_view given,
                  double duration, std::uint64_t seed) {
  const std::size_t room = options.buffer - std::min(options.buffer, state.waiting.size());
  state.waiting.append(given.substr(0, room));
  state.lost += given.size() - std::min(room, given.size());
  state.credit += options.baud / kBitsPerByte * std::max(0.0, duration);
  const auto able = static_cast<std::size_t>(
      std::min(std::floor(state.credit), static_cast<double>(state.waiting.size())));
  std::size_t size = std::string_view(state.waiting).substr(0, able).rfind('\n') + 1;  // 0: none
  const bool endless = size == 0 && able == options.buffer;  // no line ends in the whole buffer
  if (endless) size = able;
  std::string arrived = state.waiting.substr(0, size);
  state.waiting.erase(0, size);
  // an idle line saves nothing up; a line on its way keeps what it has used
  state.credit =
      std::min(state.credit - static_cast<double>(size), static_cast<double>(state.waiting.size()));
  if (options.bit_error_rate > 0.0) {
    for (std::size_t i = 0; i < arrived.size(); ++i) {
      RandomStream draw = keyed_stream(seed, options.name, 0, state.carried + i);
      for (unsigned bit = 0; bit < 8; ++bit) {
        if (draw.uniform() >= options.bit_error_rate) continue;
        arrived[i] = static_cast<char>(static_cast<unsigned char>(arrived[i]) ^ (1U << bit));
        ++state.turned;
      }
    }
  }
  state.carried += arrived.size();
  return arrived;
}

}  // namespace bathyal
