// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>

#include "bathyal/base/error.hpp"
#include "bathyal/protocol/nmea.hpp"

// Any stream gives sentences that come back from their own text, and counts that add up.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  bathyal::NmeaReader reader;
  std::uint64_t bodies = 0;
  const auto body = [&bodies](std::string_view found) {
    ++bodies;
    if (found.empty() || found.size() >= bathyal::NmeaReader::kLongest) std::abort();
    const std::size_t star = found.find('*');
    if (star == std::string_view::npos) bathyal::nmea_sentence(found);
    try {
      const bathyal::NmeaFix fix = bathyal::read_gga(found);
      if (fix.valid && !(fix.latitude >= -90.0 && fix.latitude <= 90.0)) std::abort();
    } catch (const bathyal::Error&) {
    }
  };
  const std::size_t cut = size > 0 ? data[0] % size : 0;
  reader.feed(bytes.substr(0, cut), body);
  reader.feed(bytes.substr(cut), body);
  if (bodies != reader.counts().sentences || reader.counts().bytes != size) std::abort();
  return 0;
}
