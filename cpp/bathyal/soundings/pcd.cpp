// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/pcd.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/soundings/file_limit.hpp"
#include "bathyal/soundings/internal/byte_source.hpp"
#include "bathyal/soundings/internal/growing_array.hpp"
#include "bathyal/soundings/internal/lzf.hpp"
#include "bathyal/soundings/internal/pcd_header.hpp"
#include "bathyal/soundings/internal/text_columns.hpp"

namespace bathyal {
namespace {

using namespace soundings;

static_assert(std::endian::native == std::endian::little, "PCD data are little-endian");

constexpr std::size_t kRecordGrain = std::size_t{1} << 14U;  ///< points converted by one thread

/// Where one number of every point lies in memory.
struct Stored {
  const char* data = nullptr;
  std::size_t step = 0;  ///< from point to point [bytes]
  char type = 'F';
  std::size_t size = 4;
};

template <class Scalar>
void convert(const Stored& from, std::size_t begin, std::size_t end, double* to,
             std::size_t to_step) {
  for (std::size_t i = begin; i < end; ++i) {
    Scalar value{};
    std::memcpy(&value, from.data + i * from.step, sizeof value);
    to[i * to_step] = static_cast<double>(value);
  }
}

void convert_any(const Stored& from, std::size_t begin, std::size_t end, double* to,
                 std::size_t to_step) {
  switch (from.type == 'F' ? 10 * from.size : from.type == 'I' ? from.size : 100 * from.size) {
    case 10 * sizeof(float):
      return convert<float>(from, begin, end, to, to_step);
    case 10 * sizeof(double):
      return convert<double>(from, begin, end, to, to_step);
    case 1:
      return convert<std::int8_t>(from, begin, end, to, to_step);
    case 2:
      return convert<std::int16_t>(from, begin, end, to, to_step);
    case 4:
      return convert<std::int32_t>(from, begin, end, to, to_step);
    case 8:
      return convert<std::int64_t>(from, begin, end, to, to_step);
    case 100:
      return convert<std::uint8_t>(from, begin, end, to, to_step);
    case 200:
      return convert<std::uint16_t>(from, begin, end, to, to_step);
    case 400:
      return convert<std::uint32_t>(from, begin, end, to, to_step);
    default:
      return convert<std::uint64_t>(from, begin, end, to, to_step);
  }
}

/// Converts `count` numbers to every `to_step`-th place.
void convert_all(const Stored& from, std::size_t count, double* to, std::size_t to_step,
                 int num_threads) {
  parallel_for(count, kRecordGrain, num_threads, [&](std::size_t begin, std::size_t end) {
    convert_any(from, begin, end, to, to_step);
  });
}

bool is_colour(const PcdField& field) {
  return (field.name == "rgb" || field.name == "rgba") && field.size == 4 && field.count == 1;
}

bool is_position(const PcdField& field) {
  return field.name == "x" || field.name == "y" || field.name == "z";
}

std::string element_name(const PcdField& field, std::size_t element) {
  return field.count == 1 ? field.name : field.name + "_" + std::to_string(element);
}

void add(Attributes& attributes, const std::string& key, Values values, const std::string& name) {
  if (!attributes.emplace(key, std::move(values)).second) {
    throw Error(name + ": two fields give the attribute " + key);
  }
}

/// Takes 0xAARRGGBB apart. `packed(i)` gives the 32 bits of point i.
template <class Packed>
void add_colours(Attributes& attributes, const PcdField& field, std::size_t count,
                 const Packed& packed, const std::string& name) {
  const std::pair<const char*, unsigned> channels[] = {
      {"red", 16}, {"green", 8}, {"blue", 0}, {"alpha", 24}};
  for (const auto& [channel, shift] : channels) {
    if (shift == 24 && field.name == "rgb") continue;
    Values::Matrix values(static_cast<Index>(count));
    for (std::size_t i = 0; i < count; ++i) {
      values(static_cast<Index>(i)) = static_cast<double>(packed(i) >> shift & 0xffU);
    }
    add(attributes, channel, std::move(values), name);
  }
}

/// The numbers of a cloud whose field `f` begins at `locate(f)`.
template <class Locate>
PointCloud convert_cloud(const PcdHeader& header, const Locate& locate, int num_threads,
                         const std::string& name) {
  PointMatrix points(static_cast<Index>(header.points), 3);
  int axis = 0;
  for (const char* axis_name : {"x", "y", "z"}) {
    convert_all(locate(*header.find(axis_name)), header.points, points.data() + axis++, 3,
                num_threads);
  }
  Attributes attributes;
  for (const PcdField& field : header.fields) {
    if (field.name == "_" || is_position(field)) continue;
    Stored from = locate(field);
    if (is_colour(field)) {
      const auto packed = [&](std::size_t i) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, from.data + i * from.step, sizeof bits);
        return bits;
      };
      add_colours(attributes, field, header.points, packed, name);
      continue;
    }
    for (std::size_t element = 0; element < field.count; ++element, from.data += field.size) {
      Values::Matrix values(static_cast<Index>(header.points));
      convert_all(from, header.points, values.data(), 1, num_threads);
      add(attributes, element_name(field, element), std::move(values), name);
    }
  }
  return PointCloud(std::move(points), std::move(attributes));
}

[[noreturn]] void throw_short(const std::string& name, std::size_t wanted, std::size_t got) {
  throw Error(name + ": cut short: expected " + std::to_string(wanted) + " bytes of points, got " +
              std::to_string(got));
}

PointCloud read_binary(const PcdHeader& header, std::string_view data, int num_threads,
                       const std::string& name) {
  const std::size_t wanted = header.points * header.point_size;
  if (data.size() < wanted) throw_short(name, wanted, data.size());
  const auto locate = [&](const PcdField& field) {
    return Stored{data.data() + field.offset, header.point_size, field.type, field.size};
  };
  return convert_cloud(header, locate, num_threads, name);
}

/// Two 32-bit sizes, packed and unpacked, then LZF data, which hold field after field.
PointCloud read_compressed(const PcdHeader& header, std::string_view data, int num_threads,
                           const std::string& name) {
  std::uint32_t sizes[2] = {0, 0};
  if (data.size() < sizeof sizes) throw_short(name, sizeof sizes, data.size());
  std::memcpy(sizes, data.data(), sizeof sizes);
  data.remove_prefix(sizeof sizes);
  const std::size_t wanted = header.points * header.point_size;
  if (data.size() < sizes[0]) throw_short(name, sizes[0], data.size());
  if (sizes[1] != wanted || wanted / kLzfMostGrowth > sizes[0]) {
    throw Error(name + ": " + std::to_string(sizes[0]) + " packed bytes said to hold " +
                std::to_string(sizes[1]) + ", and the header asks for " + std::to_string(wanted));
  }
  const auto unpacked = std::make_unique_for_overwrite<char[]>(wanted);
  if (!unpack_lzf(data.substr(0, sizes[0]), unpacked.get(), wanted)) {
    throw Error(name + ": the packed data are damaged");
  }
  const auto locate = [&](const PcdField& field) {
    return Stored{unpacked.get() + field.offset * header.points, field.size * field.count,
                  field.type, field.size};
  };
  return convert_cloud(header, locate, num_threads, name);
}

/// x, y, z first, then every other number but padding, as one row of the reader of text.
TextFormat ascii_format(const PcdHeader& header) {
  TextFormat format;
  format.slot.assign(header.columns, -1);
  for (const char* axis : {"x", "y", "z"}) {
    format.slot[header.find(axis)->column] = format.chosen++;
  }
  for (const PcdField& field : header.fields) {
    if (field.name == "_" || is_position(field)) continue;
    for (std::size_t i = 0; i < field.count; ++i) format.slot[field.column + i] = format.chosen++;
  }
  format.lines_before = static_cast<Index>(header.lines);
  return format;
}

/// The bits of a colour that a text gives as a float or as a whole number.
std::uint32_t colour_bits(double value, char type) {
  if (!std::isfinite(value)) return 0;
  if (type == 'F') {
    const bool fits = std::abs(value) <= std::numeric_limits<float>::max();
    return fits ? std::bit_cast<std::uint32_t>(static_cast<float>(value)) : 0;
  }
  return std::abs(value) < 0x1p33 ? static_cast<std::uint32_t>(static_cast<std::int64_t>(value))
                                  : 0;
}

PointCloud read_ascii(const PcdHeader& header, std::string_view data, int num_threads,
                      const std::string& name) {
  const auto source = open_memory(data);
  TextBlocks blocks(*source);
  blocks.start(TextCut::kLine);
  const TextTable table = read_columns(blocks, ascii_format(header), 3, num_threads, name);
  if (table.rows != static_cast<Index>(header.points)) {
    throw Error(name + ": expected " + std::to_string(header.points) + " points, got " +
                std::to_string(table.rows));
  }
  Attributes attributes;
  std::size_t column = 0;
  for (const PcdField& field : header.fields) {
    if (field.name == "_" || is_position(field)) continue;
    if (is_colour(field)) {
      const double* const values = table.extra[column++].data();
      add_colours(
          attributes, field, header.points,
          [&](std::size_t i) { return colour_bits(values[i], field.type); }, name);
      continue;
    }
    for (std::size_t element = 0; element < field.count; ++element) {
      add(attributes, element_name(field, element), table.extra[column++], name);
    }
  }
  return PointCloud(Points(table.table.data(), table.rows, table.table.owner()),
                    std::move(attributes));
}

}  // namespace

PointCloud read_pcd(const std::filesystem::path& path, int num_threads) {
  constexpr std::size_t kPiece = std::size_t{4} << 20U;
  const auto file = open_file(path);
  GrowingArray<char> bytes;
  while (true) {
    const std::size_t got = file->read(bytes.room_for(kPiece), kPiece);
    bytes.commit(got);
    if (got < kPiece) break;
  }
  return parse_pcd({bytes.data(), bytes.size()}, num_threads, printable(path.native(), 400));
}

PointCloud parse_pcd(std::string_view bytes, int num_threads, const std::string& name) {
  resolve_threads(num_threads);
  if (bytes.empty()) throw Error(name + ": the file is empty");
  const PcdHeader header = read_pcd_header(bytes, name);
  const std::string_view data = bytes.substr(header.bytes);
  // Every number becomes a double.
  const auto numbers = static_cast<double>(header.points) * static_cast<double>(header.columns);
  check_bytes(name + ": what the header announces", numbers * sizeof(double));
  switch (header.data) {
    case PcdData::kAscii:
      return read_ascii(header, data, num_threads, name);
    case PcdData::kBinary:
      return read_binary(header, data, num_threads, name);
    default:
      return read_compressed(header, data, num_threads, name);
  }
}

}  // namespace bathyal
