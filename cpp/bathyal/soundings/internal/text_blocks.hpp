// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include "bathyal/soundings/internal/byte_source.hpp"
#include "bathyal/soundings/internal/growing_array.hpp"

namespace bathyal::soundings {

/// Longest line, or longest run without a blank where blanks are what counts [bytes].
inline constexpr std::size_t kLongestPiece = std::size_t{1} << 20U;

/// Alignment of what a part of a block is parsed to: its counters change with every number, and a
/// cache line (or the pair of them that is fetched together) that two threads write costs more than
/// the second thread gains [bytes].
inline constexpr std::size_t kPartAlignment = 128;

/// Where a text may be cut between two threads.
enum class TextCut { kLine, kBlank };

/// Feeds a text of any length through two buffers of a few megabytes, block by block, each block
/// ending where the text may be cut. While the parts of one block are parsed, the next is read.
class TextBlocks {
 public:
  explicit TextBlocks(ByteSource& source);

  /// The first bytes of the text, up to kBlock, cut or not: to see what it is before `start`.
  std::string_view head() const { return {current().bytes.data(), current().filled}; }

  /// Makes the first block the current one.
  void start(TextCut cut);

  /// The current block: whole lines (or whole words), of which the last ends in a line end (or a
  /// blank) even where the source does not. kTextPadding bytes after it are readable. Empty at the
  /// end of the text.
  std::string_view block() const;

  /// Whether there is no block because no place to cut was found within kLongestPiece.
  bool too_long() const { return current().too_long; }

  /// Where the current block begins in the source [bytes].
  std::size_t offset() const { return current().offset + current().begin; }

  /// Calls `parse(i, text)` once for each part i of the current block, on `num_threads` threads,
  /// and meanwhile reads the next block, which then becomes the current one. The parts are the same
  /// for any number of threads. `parse` must not throw what depends on the order of the calls.
  void parse_parts(int num_threads,
                   const std::function<void(std::size_t, std::string_view)>& parse);

  /// How many parts the current block has.
  std::size_t part_count() const { return parts_.size(); }

  /// The current block and the rest of the source, as far as its size is known [bytes].
  std::size_t bytes_left() const;

  /// Drops the front of the current block (a header that has been read).
  void skip(std::size_t bytes);

  /// Two of them and what they are parsed to stay in a core's cache; less would make the threads
  /// wait for one another more often.
  static constexpr std::size_t kBlock = std::size_t{2} << 20U;
  static constexpr std::size_t kPart = std::size_t{128} << 10U;

 private:
  struct Buffer {
    GrowingArray<char> bytes;  ///< only its memory is used: no larger than the source needs
    std::size_t offset = 0;    ///< of bytes[0] in the source
    std::size_t begin = 0;     ///< of the block
    std::size_t cut = 0;       ///< end of the block
    std::size_t filled = 0;    ///< end of what has been read
    bool too_long = false;
  };

  const Buffer& current() const { return buffers_[turn_]; }
  void fill(Buffer& buffer, std::string_view left_over);
  void find_cut(Buffer& buffer);
  void read_ahead();
  void split();

  ByteSource& source_;
  TextCut cut_ = TextCut::kLine;
  std::array<Buffer, 2> buffers_;
  std::size_t turn_ = 0;
  bool at_end_ = false;
  std::vector<std::string_view> parts_;
};

}  // namespace bathyal::soundings
