// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/text_blocks.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "bathyal/base/parallel.hpp"
#include "bathyal/soundings/internal/parse_number.hpp"

namespace bathyal::soundings {
namespace {

/// Whether the text may be cut in front of bytes[i]; i > 0, and bytes[i] is known. "\r\n" is one
/// line end.
bool may_cut(const char* bytes, std::size_t i, TextCut cut) {
  const char before = bytes[i - 1];
  if (before == '\n') return true;
  if (cut == TextCut::kLine) return before == '\r' && bytes[i] != '\n';
  return before == ' ' || before == '\t' || before == '\r';
}

}  // namespace

TextBlocks::TextBlocks(ByteSource& source) : source_(source) { fill(buffers_[turn_], {}); }

void TextBlocks::start(TextCut cut) {
  cut_ = cut;
  find_cut(buffers_[turn_]);
  split();
}

std::string_view TextBlocks::block() const {
  return {current().bytes.data() + current().begin, current().cut - current().begin};
}

void TextBlocks::skip(std::size_t bytes) {
  buffers_[turn_].begin += bytes;
  split();
}

std::size_t TextBlocks::bytes_left() const {
  const std::size_t here = current().filled - current().begin;
  const std::size_t behind = at_end_ ? 0 : source_.bytes_left();
  return behind > std::numeric_limits<std::size_t>::max() - here ? here : here + behind;
}

void TextBlocks::parse_parts(int num_threads,
                             const std::function<void(std::size_t, std::string_view)>& parse) {
  // Reading is the first task drawn, so it runs during the parsing and not after it.
  parallel_for(parts_.size() + 1, 1, num_threads, [&](std::size_t task, std::size_t) {
    if (task == 0) {
      read_ahead();
    } else {
      parse(task - 1, parts_[task - 1]);
    }
  });
  turn_ = 1 - turn_;
  split();
}

/// Appends fresh bytes to the remainder of the last block.
void TextBlocks::fill(Buffer& buffer, std::string_view left_over) {
  const std::size_t want = at_end_ ? 0 : std::min(kBlock - 1, source_.bytes_left()) + 1;
  char* const bytes = buffer.bytes.room_for(left_over.size() + want + 1 + kTextPadding);
  if (!left_over.empty()) std::memcpy(bytes, left_over.data(), left_over.size());
  const std::size_t got = want == 0 ? 0 : source_.read(bytes + left_over.size(), want);
  at_end_ = got < want || want == 0;
  buffer.filled = left_over.size() + got;
}

/// The last place where a cut may be made; at the end of the text that is its end.
void TextBlocks::find_cut(Buffer& buffer) {
  char* const bytes = buffer.bytes.room_for(0);
  if (at_end_) {
    if (buffer.filled > 0 && bytes[buffer.filled - 1] != '\n') bytes[buffer.filled++] = '\n';
    buffer.cut = buffer.filled;
  } else {
    buffer.cut = buffer.filled - 1;
    while (buffer.cut > 0 && !may_cut(bytes, buffer.cut, cut_)) --buffer.cut;
    buffer.too_long = buffer.cut == 0;
  }
  std::memset(bytes + buffer.filled, 0, kTextPadding);
}

/// Fills the other buffer with the remainder of the current block, and fresh bytes after it.
void TextBlocks::read_ahead() {
  const Buffer& now = current();
  Buffer& next = buffers_[1 - turn_];
  const std::string_view left_over(now.bytes.data() + now.cut, now.filled - now.cut);
  next.offset = now.offset + now.cut;
  next.begin = 0;
  next.cut = 0;
  next.filled = 0;
  next.too_long = left_over.size() > kLongestPiece;
  if (next.too_long) return;
  fill(next, left_over);
  find_cut(next);
}

void TextBlocks::split() {
  parts_.clear();
  const std::string_view text = block();
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = std::min(begin + kPart, text.size());
    while (end < text.size() && !may_cut(text.data(), end, cut_)) ++end;
    parts_.push_back(text.substr(begin, end - begin));
    begin = end;
  }
}

}  // namespace bathyal::soundings
