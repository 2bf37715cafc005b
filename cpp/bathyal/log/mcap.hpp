// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace bathyal {

/// A kind of message in a log, by name and what describes its data.
struct McapSchema {
  std::string name, encoding, data;  ///< "jsonschema" and a JSON Schema
};

/// A series of messages of one schema.
struct McapChannel {
  std::uint16_t schema = 0;  ///< id, from 1; 0: none
  std::string topic, encoding;
};

/// Where a chunk is and what it spans, for the index at the file's end.
struct McapChunk {
  std::uint64_t start = 0, length = 0, first = 0, last = 0, size = 0, index_length = 0;
  std::vector<std::pair<std::uint16_t, std::uint64_t>> index_offsets;
};

/// All that a writer remembers but the open file: from it the same file is continued.
struct McapWriterState {
  std::uint64_t written = 0;          ///< bytes of the file
  std::string pending;                ///< records of the chunk that is open
  std::uint64_t first = 0, last = 0;  ///< times in it [ns]
  std::vector<std::vector<std::pair<std::uint64_t, std::uint64_t>>> index;  ///< by channel
  std::vector<McapSchema> schemas;
  std::vector<McapChannel> channels;
  std::vector<std::uint64_t> counts;  ///< messages of each channel
  std::vector<std::uint32_t> sequence;
  std::vector<McapChunk> chunks;
  std::uint64_t earliest = 0, latest = 0;
};

/// Writes a log in the MCAP format (Foxglove, specification 0): chunks without compression, each
/// with its index and checksum, a summary at the end. A file that breaks off keeps all chunks that
/// were whole. The same calls give the same bytes.
class McapWriter {
 public:
  /// A new file. \throw Error that names the path where it cannot be written
  explicit McapWriter(const std::string& path, std::size_t chunk_size = 1U << 18U);

  /// Goes on with a file that `state` was saved of; what is longer is cut off.
  McapWriter(const std::string& path, McapWriterState state, std::size_t chunk_size = 1U << 18U);

  std::uint16_t add_schema(const McapSchema& schema);     ///< \return its id
  std::uint16_t add_channel(const McapChannel& channel);  ///< \return its id, from 1

  /// \param time [ns], of channels of an id that was given \throw Error where the disk is full
  void write(std::uint16_t channel, std::uint64_t time, std::string_view data);

  /// Closes the chunk that is open, so that a crash loses nothing before this moment.
  void flush();

  /// What is written is in the file; the chunk that is open stays so. \throw Error where the disk
  /// is full, or the log is closed or was not written to its end: its state is no file's then
  void sync();

  /// The last chunk, the summary and the end. \throw Error where the disk is full
  void close();

  const McapWriterState& state() const { return state_; }

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void put(std::string_view bytes);
  void finish_chunk();

  std::string path_;
  std::size_t chunk_size_;
  std::unique_ptr<std::FILE, Closer> file_;
  McapWriterState state_;
  bool has_messages_ = false;  ///< the chunk that is open
};

/// A message as it is in a file.
struct McapMessage {
  std::string_view topic, schema, data;
  std::uint64_t time = 0;  ///< [ns]
  std::uint32_t sequence = 0;
};

/// Hands over all messages of a file's bytes, in their order; those of a chunk that breaks off,
/// too, as far as they are whole. Chunks must be without compression. \return why it breaks off;
/// empty for a whole file \throw Error for bytes that are no MCAP, or chunks that are compressed
std::string read_mcap(std::string_view bytes,
                      const std::function<void(const McapMessage&)>& message);

}  // namespace bathyal
