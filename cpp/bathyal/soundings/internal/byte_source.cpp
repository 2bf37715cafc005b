// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/byte_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "bathyal/base/error.hpp"
#include "bathyal/soundings/file_limit.hpp"

namespace bathyal::soundings {
namespace {

[[noreturn]] void throw_system(const std::string& name, int code) {
  throw Error(name + ": " + std::generic_category().message(code));
}

class FileSource final : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& path)
      : name_(printable(path.native(), 400)), file_(::open(path.c_str(), kReadOnly)) {
    if (file_ < 0) throw_system(name_, errno);
    try {
      left_ = checked_size();
    } catch (...) {
      ::close(file_);
      throw;
    }
  }
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;
  ~FileSource() override { ::close(file_); }

  std::size_t read(char* to, std::size_t size) override {
    size = std::min(size, left_);
    std::size_t done = 0;
    while (done < size) {
      const ssize_t got = ::read(file_, to + done, size - done);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw_system(name_, errno);
      if (got == 0) break;
      done += static_cast<std::size_t>(got);
    }
    left_ = done < size ? 0 : left_ - done;
    return done;
  }

  std::size_t bytes_left() const override { return left_; }

 private:
  // Without O_NONBLOCK, open waits for the other end of a pipe.
  static constexpr int kReadOnly = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;

  /// Of the file that is open, whatever its path names by now.
  std::size_t checked_size() const {
    struct stat status {};
    if (::fstat(file_, &status) != 0) throw_system(name_, errno);
    if (S_ISDIR(status.st_mode)) throw_system(name_, EISDIR);
    if (!S_ISREG(status.st_mode)) {
      throw Error(name_ + ": expected a regular file, got a pipe or a device");
    }
    check_bytes(name_ + ": the file", static_cast<double>(status.st_size));
    return static_cast<std::size_t>(status.st_size);
  }

  std::string name_;
  int file_;
  std::size_t left_ = 0;
};

class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::string_view bytes) : bytes_(bytes) {}

  std::size_t read(char* to, std::size_t size) override {
    const std::size_t count = std::min(size, bytes_.size());
    if (count > 0) std::memcpy(to, bytes_.data(), count);
    bytes_.remove_prefix(count);
    return count;
  }

  std::size_t bytes_left() const override { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

/// Length of the well-formed UTF-8 sequence of two to four bytes at the front of `text`, 0 if none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return 0;
  }
  const bool overlong = (byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xf0 && byte(1) < 0x90);
  const bool surrogate = byte(0) == 0xed && byte(1) >= 0xa0;
  const bool beyond = byte(0) == 0xf4 && byte(1) >= 0x90;
  return overlong || surrogate || beyond ? 0 : length;
}

}  // namespace

std::unique_ptr<ByteSource> open_file(const std::filesystem::path& path) {
  return std::make_unique<FileSource>(path);
}

std::unique_ptr<ByteSource> open_memory(std::string_view bytes) {
  return std::make_unique<MemorySource>(bytes);
}

std::string printable(std::string_view text, std::size_t limit) {
  std::string result;
  while (!text.empty() && result.size() < limit) {
    const auto byte = static_cast<unsigned char>(text.front());
    std::size_t length = byte >= 0x80 ? utf8_length(text) : 1;
    if (length == 0 || byte < 0x20 || byte == 0x7f) {
      std::array<char, 5> escaped{};
      std::snprintf(escaped.data(), escaped.size(), "\\x%02x", byte);
      result += byte == '\t' ? "\\t" : escaped.data();
      length = 1;
    } else {
      result.append(text.substr(0, length));
    }
    text.remove_prefix(length);
  }
  return text.empty() ? result : result + "…";
}

}  // namespace bathyal::soundings
