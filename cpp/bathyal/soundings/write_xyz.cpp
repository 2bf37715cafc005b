// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/write_xyz.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <system_error>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/soundings/internal/byte_source.hpp"

namespace bathyal {
namespace {

using namespace soundings;

constexpr std::size_t kLongestNumber = 352;  ///< −DBL_MAX with 17 decimals has 328 characters
constexpr std::size_t kRowsAtOnce = 4096;    ///< formatted by one thread
constexpr std::size_t kBatch = 32;           ///< such pieces between two writes
constexpr int kFastDecimals = 9;

__extension__ using Wide = unsigned __int128;

char* write_digits(char* to, std::uint64_t value) { return std::to_chars(to, to + 20, value).ptr; }

/// value with fixed decimals, rounded half to even as exact arithmetic demands: the 53 bits of the
/// double times 10^decimals is a whole number of at most 83 bits, which a shift then rounds.
/// nullptr where the value is too large for that.
char* write_fixed_fast(char* to, double value, int decimals) {
  static constexpr std::uint64_t kTens[] = {1,      10,      100,      1000,      10000,
                                            100000, 1000000, 10000000, 100000000, 1000000000};
  int exponent = 0;
  const double fraction = std::frexp(std::abs(value), &exponent);
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
  const int shift = 53 - exponent;
  if (shift < 20) return nullptr;  // |value| ≥ 2³³: the whole number may need more than 63 bits
  std::uint64_t scaled = 0;
  if (shift < 120) {
    const Wide exact = static_cast<Wide>(mantissa) * kTens[decimals];
    const Wide rest = exact & ((Wide{1} << shift) - 1);
    const Wide half = Wide{1} << (shift - 1);
    scaled = static_cast<std::uint64_t>(exact >> shift);
    if (rest > half || (rest == half && (scaled & 1U) != 0)) ++scaled;
  }
  if (std::signbit(value)) *to++ = '-';
  to = write_digits(to, scaled / kTens[decimals]);
  if (decimals == 0) return to;
  *to++ = '.';
  std::uint64_t behind = scaled % kTens[decimals];
  for (int i = decimals - 1; i >= 0; --i, behind /= 10)
    to[i] = static_cast<char>('0' + behind % 10);
  return to + decimals;
}

char* write_number(char* to, double value, int decimals) {
  if (decimals >= 0 && decimals <= kFastDecimals && std::isfinite(value)) {
    if (char* const end = write_fixed_fast(to, value, decimals)) return end;
  }
  char* const limit = to + kLongestNumber;
  if (decimals < 0) return std::to_chars(to, limit, value).ptr;
  return std::to_chars(to, limit, value, std::chars_format::fixed, decimals).ptr;
}

/// A file that is only written to, front to back.
class FileSink {
 public:
  explicit FileSink(const std::filesystem::path& path)
      : name_(printable(path.native(), 400)),
        file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
    if (file_ < 0) fail();
  }
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;
  ~FileSink() {
    if (file_ >= 0) ::close(file_);
  }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t done = ::write(file_, bytes.data(), bytes.size());
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) fail();
      bytes.remove_prefix(static_cast<std::size_t>(done));
    }
  }

  /// Some file systems report a full disk only now.
  void close() {
    const int file = std::exchange(file_, -1);
    if (::close(file) != 0) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(name_ + ": " + std::generic_category().message(errno));
  }

  std::string name_;
  int file_;
};

std::vector<const double*> wanted_attributes(const PointCloud& cloud,
                                             const std::vector<std::string>& names) {
  std::vector<const double*> columns;
  for (const std::string& name : names) {
    const auto found = cloud.attributes().find(name);
    if (found == cloud.attributes().end()) {
      throw_argument("attributes", "names of attributes that the cloud has", "\"" + name + "\"");
    }
    columns.push_back(found->second.data());
  }
  return columns;
}

void write_rows(const PointCloud& cloud, const std::vector<const double*>& columns,
                std::size_t begin, std::size_t end, const WriteXyzOptions& options,
                std::string& text) {
  // Room for the longest numbers there are would be ten times what nearly all need.
  text.clear();
  std::vector<char> line((3 + columns.size()) * (kLongestNumber + 1));
  const double* point = cloud.points().data() + 3 * begin;
  for (std::size_t i = begin; i < end; ++i, point += 3) {
    char* to = write_number(line.data(), point[0], options.decimals);
    for (int axis = 1; axis < 3; ++axis) {
      *to++ = options.separator;
      to = write_number(to, point[axis], options.decimals);
    }
    for (const double* column : columns) {
      *to++ = options.separator;
      to = write_number(to, column[i], options.decimals);
    }
    *to++ = '\n';
    text.append(line.data(), static_cast<std::size_t>(to - line.data()));
  }
}

}  // namespace

void WriteXyzOptions::check() const {
  if (decimals < -1 || decimals > 17) {
    throw_argument("decimals", "0 to 17, or -1 for the shortest", std::to_string(decimals));
  }
  if (std::string_view(" ,;\t").find(separator) == std::string_view::npos) {
    throw_argument("separator", "a blank, comma, semicolon or tab", std::string(1, separator));
  }
  resolve_threads(num_threads);
}

void write_xyz(const std::filesystem::path& path, const PointCloud& cloud,
               const WriteXyzOptions& options) {
  options.check();
  const std::vector<const double*> columns = wanted_attributes(cloud, options.attributes);
  FileSink file(path);
  file.write(options.preamble);
  if (options.header) {
    std::string line = std::string("x") + options.separator + "y" + options.separator + "z";
    for (const std::string& name : options.attributes) line += options.separator + name;
    file.write(line + "\n");
  }
  const auto rows = static_cast<std::size_t>(cloud.size());
  std::vector<std::string> pieces(kBatch);
  for (std::size_t first = 0; first < rows; first += kBatch * kRowsAtOnce) {
    const std::size_t count = std::min(kBatch * kRowsAtOnce, rows - first);
    parallel_for(count, kRowsAtOnce, options.num_threads, [&](std::size_t begin, std::size_t end) {
      write_rows(cloud, columns, first + begin, first + end, options, pieces[begin / kRowsAtOnce]);
    });
    for (std::size_t i = 0; i * kRowsAtOnce < count; ++i) file.write(pieces[i]);
  }
  file.close();
}

}  // namespace bathyal
