// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace bathyal::soundings {

/// Bytes that are read once, front to back: a file or memory.
class ByteSource {
 public:
  virtual ~ByteSource() = default;

  /// Reads up to `size` bytes; fewer than `size` only at the end.
  /// \throw Error that names the source when the system cannot read it.
  virtual std::size_t read(char* to, std::size_t size) = 0;

  /// Bytes not read yet: an upper bound to check a header's claims against before anything is
  /// allocated.
  virtual std::size_t bytes_left() const = 0;
};

/// Never waits for the other end of a pipe. What is appended while the file is read is not read.
/// \throw Error that names the path and the reason: missing, not readable, no regular file, larger
///   than `most_bytes`.
std::unique_ptr<ByteSource> open_file(const std::filesystem::path& path);

/// `bytes` must outlive the source.
std::unique_ptr<ByteSource> open_memory(std::string_view bytes);

/// Text fit for a message: valid UTF-8 as it is, anything else as \xNN, and no more than
/// `limit` bytes of it.
std::string printable(std::string_view text, std::size_t limit = 60);

}  // namespace bathyal::soundings
