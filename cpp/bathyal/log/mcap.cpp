// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/log/mcap.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/log/crc32.hpp"

namespace bathyal {
namespace {

constexpr std::uint64_t kMessageHead = 22;  ///< bytes of a message's record before its data
constexpr const char* kClosed = ": the log is closed";
constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);

enum Op : std::uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

static_assert(std::endian::native == std::endian::little, "numbers are written as in memory");

/// Numbers one after another, little-endian.
template <class... Numbers>
std::array<char, (sizeof(Numbers) + ...)> packed(Numbers... values) {
  std::array<char, (sizeof(Numbers) + ...)> bytes;
  char* at = bytes.data();
  ((std::memcpy(at, &values, sizeof values), at += sizeof values), ...);
  return bytes;
}

template <std::size_t Size>
void append(std::string& to, const std::array<char, Size>& bytes) {
  to.append(bytes.data(), Size);
}

/// Little-endian numbers and texts with their lengths.
class Bytes {
 public:
  template <class Number>
  Bytes& number(Number value) {
    append(text_, packed(value));
    return *this;
  }
  Bytes& text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    text_.append(value);
    return *this;
  }
  Bytes& raw(std::string_view value) {
    text_.append(value);
    return *this;
  }
  const std::string& get() const { return text_; }

 private:
  std::string text_;
};

void add_record(std::string& to, Op op, std::string_view content) {
  append(to, packed(static_cast<std::uint8_t>(op), std::uint64_t{content.size()}));
  to.append(content);
}

std::string record(Op op, std::string_view content) {
  std::string all;
  add_record(all, op, content);
  return all;
}

std::string schema_record(std::uint16_t id, const McapSchema& schema) {
  Bytes bytes;
  bytes.number(id).text(schema.name).text(schema.encoding).text(schema.data);
  return record(kSchema, bytes.get());
}

std::string channel_record(std::uint16_t id, const McapChannel& channel) {
  Bytes bytes;
  bytes.number(id).number(channel.schema).text(channel.topic).text(channel.encoding);
  bytes.number(std::uint32_t{0});  // no metadata
  return record(kChannel, bytes.get());
}

std::string chunk_index(const McapChunk& chunk) {
  Bytes offsets;
  for (const auto& [channel, at] : chunk.index_offsets) offsets.number(channel).number(at);
  Bytes bytes;
  bytes.number(chunk.first).number(chunk.last).number(chunk.start).number(chunk.length);
  bytes.text(offsets.get()).number(chunk.index_length).text("");
  bytes.number(chunk.size).number(chunk.size);
  return record(kChunkIndex, bytes.get());
}

std::string statistics(const McapWriterState& state) {
  Bytes counts;
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < state.counts.size(); ++i) {
    all += state.counts[i];
    counts.number(static_cast<std::uint16_t>(i + 1)).number(state.counts[i]);
  }
  Bytes bytes;
  bytes.number(all).number(static_cast<std::uint16_t>(state.schemas.size()));
  bytes.number(static_cast<std::uint32_t>(state.channels.size()));
  bytes.number(std::uint32_t{0}).number(std::uint32_t{0});  // attachments, metadata
  bytes.number(static_cast<std::uint32_t>(state.chunks.size()));
  bytes.number(state.earliest).number(state.latest).text(counts.get());
  return record(kStatistics, bytes.get());
}

/// Reads what is in memory, and says where it ends too early.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <class Number>
  std::optional<Number> number() {
    if (bytes_.size() < sizeof(Number)) return std::nullopt;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[i])) << (8 * i);
    }
    bytes_.remove_prefix(sizeof(Number));
    return static_cast<Number>(value);
  }
  std::optional<std::string_view> take(std::uint64_t size) {
    if (size > bytes_.size()) return std::nullopt;
    const std::string_view part = bytes_.substr(0, static_cast<std::size_t>(size));
    bytes_.remove_prefix(part.size());
    return part;
  }
  std::optional<std::string_view> text() {
    const auto size = number<std::uint32_t>();
    return size ? take(*size) : std::nullopt;
  }
  std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

/// What a reader knows so far.
struct Known {
  std::map<std::uint16_t, std::string_view> schemas;
  std::map<std::uint16_t, std::pair<std::uint16_t, std::string_view>> channels;
};

/// \return why the records break off
std::string read_records(std::string_view bytes, Known& known,
                         const std::function<void(const McapMessage&)>& message, bool inside,
                         bool& ended);

std::string read_chunk(std::string_view content, bool whole, Known& known,
                       const std::function<void(const McapMessage&)>& message) {
  constexpr const char* kShort = "a chunk breaks off";
  Reader reader(content);
  const auto first = reader.number<std::uint64_t>(), last = reader.number<std::uint64_t>();
  const auto size = reader.number<std::uint64_t>();
  const auto crc = reader.number<std::uint32_t>();
  const auto compression = reader.text();
  const auto length = reader.number<std::uint64_t>();
  if (!first || !last || !size || !crc || !compression || !length) return kShort;
  if (!compression->empty()) {
    std::string text("expected chunks without compression, got '");
    text.append(compression->substr(0, 20)).append("'");
    throw Error(text);
  }
  const auto records = reader.take(*length);
  if (whole && records && *crc != 0 && crc32(*records) != *crc) {
    return "a chunk's checksum does not fit";
  }
  bool ended = false;
  const std::string reason =
      read_records(records ? *records : reader.rest(), known, message, true, ended);
  return records ? reason : kShort;
}

std::string take_message(Reader reader, const Known& known,
                         const std::function<void(const McapMessage&)>& message) {
  const auto channel = reader.number<std::uint16_t>();
  const auto sequence = reader.number<std::uint32_t>();
  const auto time = reader.number<std::uint64_t>(), published = reader.number<std::uint64_t>();
  if (!channel || !sequence || !time || !published) return "a message is too short";
  const auto found = known.channels.find(*channel);
  if (found == known.channels.end()) return "a message is of a channel that there is not";
  McapMessage read;
  read.topic = found->second.second;
  const auto schema = known.schemas.find(found->second.first);
  if (schema != known.schemas.end()) read.schema = schema->second;
  read.data = reader.rest();
  read.time = *time;
  read.sequence = *sequence;
  message(read);
  return {};
}

std::string read_records(std::string_view bytes, Known& known,
                         const std::function<void(const McapMessage&)>& message, bool inside,
                         bool& ended) {
  Reader reader(bytes);
  while (!reader.rest().empty() && !ended) {
    if (!inside && reader.rest().starts_with(kMagic)) {
      ended = true;
      break;
    }
    const auto op = reader.number<std::uint8_t>();
    const auto length = reader.number<std::uint64_t>();
    if (!op || !length) return "a record breaks off";
    const auto content = reader.take(*length);
    if (!content) {
      if (*op == kChunk && !inside) read_chunk(reader.rest(), false, known, message);
      return "a record breaks off";
    }
    Reader part(*content);
    std::string reason;
    if (*op == kSchema) {
      const auto id = part.number<std::uint16_t>();
      const auto name = part.text();
      if (!id || !name) return "a schema is too short";
      known.schemas.emplace(*id, *name);
    } else if (*op == kChannel) {
      const auto id = part.number<std::uint16_t>(), schema = part.number<std::uint16_t>();
      const auto topic = part.text();
      if (!id || !schema || !topic) return "a channel is too short";
      known.channels.emplace(*id, std::pair(*schema, *topic));
    } else if (*op == kMessage) {
      reason = take_message(part, known, message);
    } else if (*op == kChunk && !inside) {
      reason = read_chunk(*content, true, known, message);
    }
    if (!reason.empty()) return reason;
  }
  return {};
}

}  // namespace

McapWriter::McapWriter(const std::string& path, std::size_t chunk_size)
    : path_(path), chunk_size_(chunk_size), file_(std::fopen(path.c_str(), "wb")) {
  if (!file_) throw Error(path_ + ": " + std::strerror(errno));
  Bytes header;
  header.text("").text("bathyal");
  put(std::string(kMagic) + record(kHeader, header.get()));
}

McapWriter::McapWriter(const std::string& path, McapWriterState state, std::size_t chunk_size)
    : path_(path), chunk_size_(chunk_size), state_(std::move(state)) {
  std::error_code failed;
  const auto size = std::filesystem::file_size(path, failed);
  if (failed || size < state_.written) {
    throw Error(path_ + ": expected at least " + std::to_string(state_.written) +
                " bytes of the log that is continued");
  }
  std::filesystem::resize_file(path, state_.written, failed);
  if (failed) throw Error(path_ + ": " + failed.message());
  has_messages_ = std::any_of(state_.index.begin(), state_.index.end(),
                              [](const auto& one) { return !one.empty(); });
  file_.reset(std::fopen(path.c_str(), "ab"));
  if (!file_) throw Error(path_ + ": " + std::strerror(errno));
}

void McapWriter::put(std::string_view bytes) {
  if (!file_) throw Error(path_ + kClosed);
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
    const std::string reason = path_ + ": " + std::strerror(errno);
    file_.reset();  // what is in the file is no longer what the state says: no save from here on
    throw Error(reason);
  }
  state_.written += bytes.size();
}

std::uint16_t McapWriter::add_schema(const McapSchema& schema) {
  state_.schemas.push_back(schema);
  const auto id = static_cast<std::uint16_t>(state_.schemas.size());
  state_.pending += schema_record(id, schema);
  return id;
}

std::uint16_t McapWriter::add_channel(const McapChannel& channel) {
  state_.channels.push_back(channel);
  state_.counts.push_back(0);
  state_.sequence.push_back(0);
  state_.index.emplace_back();
  const auto id = static_cast<std::uint16_t>(state_.channels.size());
  state_.pending += channel_record(id, channel);
  return id;
}

void McapWriter::write(std::uint16_t channel, std::uint64_t time, std::string_view data) {
  const std::size_t row = channel - std::size_t{1};
  if (row >= state_.channels.size()) {
    throw_argument("channel", "one that was added", std::to_string(channel));
  }
  const bool first = !has_messages_;
  has_messages_ = true;
  state_.first = first ? time : std::min(state_.first, time);
  state_.last = first ? time : std::max(state_.last, time);
  state_.index[row].emplace_back(time, state_.pending.size());
  append(state_.pending, packed(std::uint8_t{kMessage}, kMessageHead + data.size(), channel,
                                state_.sequence[row]++, time, time));
  state_.pending.append(data);
  const bool none = state_.earliest == 0 && state_.latest == 0 && state_.counts[row] == 0;
  state_.earliest = none ? time : std::min(state_.earliest, time);
  state_.latest = std::max(state_.latest, time);
  ++state_.counts[row];
  if (state_.pending.size() >= chunk_size_) finish_chunk();
}

void McapWriter::finish_chunk() {
  if (state_.pending.empty()) return;
  McapChunk chunk;
  chunk.start = state_.written;
  chunk.first = state_.first;
  chunk.last = state_.last;
  chunk.size = state_.pending.size();
  Bytes head;
  head.number(chunk.first).number(chunk.last).number(chunk.size);
  head.number(crc32(state_.pending)).text("").number(chunk.size);
  Bytes frame;
  frame.number(static_cast<std::uint8_t>(kChunk));
  frame.number(static_cast<std::uint64_t>(head.get().size() + chunk.size)).raw(head.get());
  put(frame.get());
  put(state_.pending);
  chunk.length = state_.written - chunk.start;
  std::string index;
  for (std::size_t i = 0; i < state_.index.size(); ++i) {
    if (state_.index[i].empty()) continue;
    const auto id = static_cast<std::uint16_t>(i + 1);
    chunk.index_offsets.emplace_back(id, state_.written + index.size());
    const auto size = static_cast<std::uint32_t>(16 * state_.index[i].size());
    append(index, packed(std::uint8_t{kMessageIndex}, std::uint64_t{6} + size, id, size));
    for (const auto& [time, offset] : state_.index[i]) append(index, packed(time, offset));
    state_.index[i].clear();
  }
  put(index);
  chunk.index_length = index.size();
  has_messages_ = false;
  state_.chunks.push_back(std::move(chunk));
  state_.pending.clear();
}

void McapWriter::flush() {
  finish_chunk();
  sync();
}

void McapWriter::sync() {
  if (!file_) throw Error(path_ + kClosed);
  if (std::fflush(file_.get()) != 0) throw Error(path_ + ": " + std::strerror(errno));
}

void McapWriter::close() {
  if (!file_) return;
  finish_chunk();
  put(record(kDataEnd, Bytes().number(std::uint32_t{0}).get()));
  const std::uint64_t summary_start = state_.written;
  std::string summary;
  Bytes offsets;
  const auto group = [&](Op op, const std::string& records) {
    if (records.empty()) return;
    Bytes bytes;
    bytes.number(static_cast<std::uint8_t>(op)).number(summary_start + summary.size());
    bytes.number(static_cast<std::uint64_t>(records.size()));
    offsets.raw(record(kSummaryOffset, bytes.get()));
    summary += records;
  };
  std::string schemas, channels, chunks;
  for (std::size_t i = 0; i < state_.schemas.size(); ++i) {
    schemas += schema_record(static_cast<std::uint16_t>(i + 1), state_.schemas[i]);
  }
  for (std::size_t i = 0; i < state_.channels.size(); ++i) {
    channels += channel_record(static_cast<std::uint16_t>(i + 1), state_.channels[i]);
  }
  for (const McapChunk& chunk : state_.chunks) chunks += chunk_index(chunk);
  group(kSchema, schemas);
  group(kChannel, channels);
  group(kStatistics, statistics(state_));
  group(kChunkIndex, chunks);
  const std::uint64_t offset_start = summary_start + summary.size();
  summary += offsets.get();
  Bytes footer;
  footer.number(static_cast<std::uint8_t>(kFooter)).number(std::uint64_t{20});
  footer.number(summary_start).number(offset_start);
  const std::uint32_t crc = crc32(summary + footer.get());
  put(summary);
  put(footer.number(crc).get());
  put(kMagic);
  if (std::fclose(file_.release()) != 0) throw Error(path_ + ": " + std::strerror(errno));
}

std::string read_mcap(std::string_view bytes,
                      const std::function<void(const McapMessage&)>& message) {
  if (!bytes.starts_with(kMagic)) throw Error("expected an MCAP file, got other bytes");
  Known known;
  bool ended = false;
  std::string reason = read_records(bytes.substr(kMagic.size()), known, message, false, ended);
  if (reason.empty() && !ended) reason = "the end is missing";
  return reason;
}

}  // namespace bathyal
