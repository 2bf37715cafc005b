// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/pcd_header.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>

#include "bathyal/base/error.hpp"
#include "bathyal/soundings/internal/byte_source.hpp"
#include "bathyal/soundings/internal/text_format.hpp"

namespace bathyal::soundings {
namespace {

constexpr std::size_t kLongestHeader = std::size_t{1} << 16U;
constexpr std::size_t kMostColumns = 4096;

struct Entry {
  std::vector<std::string> words;
  std::size_t line = 0;
};
using Entries = std::map<std::string, Entry>;

[[noreturn]] void fail(const std::string& name, const Entry& entry, const std::string& why) {
  throw Error(name + ":" + std::to_string(entry.line) + ": " + why);
}

/// The header's lines up to and with DATA, by their first word.
Entries header_entries(std::string_view bytes, const std::string& name, PcdHeader& header) {
  static constexpr std::string_view kKeys[] = {"VERSION", "FIELDS", "COLUMNS",  "SIZE",
                                               "TYPE",    "COUNT",  "WIDTH",    "HEIGHT",
                                               "POINTS",  "DATA",   "VIEWPOINT"};
  const std::string_view head = bytes.substr(0, kLongestHeader);
  std::string_view rest = head;
  Entries entries;
  TextFormat blanks;
  std::vector<std::string_view> words;
  while (!rest.empty()) {
    const std::string_view line = take_line(rest);
    ++header.lines;
    split_fields(line, blanks, 0, words);
    if (words.empty() || words.front().starts_with('#')) continue;
    const std::string key(words.front());
    if (std::find(std::begin(kKeys), std::end(kKeys), key) == std::end(kKeys)) {
      throw Error(name + ":" + std::to_string(header.lines) +
                  ": expected a line of a PCD header, got \"" + printable(line) + "\"");
    }
    Entry& entry = entries[key == "COLUMNS" ? "FIELDS" : key];
    if (entry.line != 0) fail(name, {{}, header.lines}, key + " for the second time");
    entry.line = header.lines;
    entry.words.assign(words.begin() + 1, words.end());
    if (key == "DATA") {
      header.bytes = head.size() - rest.size();
      return entries;
    }
  }
  throw Error(name + ": no DATA line in the first " + std::to_string(head.size()) +
              " bytes: not a PCD file, or cut short");
}

const Entry* find_entry(const Entries& entries, const char* key) {
  const auto found = entries.find(key);
  return found == entries.end() ? nullptr : &found->second;
}

const Entry& require(const Entries& entries, const char* key, const std::string& name) {
  if (const Entry* entry = find_entry(entries, key)) return *entry;
  throw Error(name + ": the header has no " + key);
}

std::size_t whole_number(const std::string& word, const Entry& entry, const std::string& name) {
  std::size_t value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ec != std::errc() || result.ptr != word.data() + word.size()) {
    fail(name, entry, "expected a whole number of 0 or more, got \"" + printable(word) + "\"");
  }
  return value;
}

std::size_t single_number(const Entry& entry, const std::string& name) {
  if (entry.words.size() != 1) fail(name, entry, "expected one whole number");
  return whole_number(entry.words.front(), entry, name);
}

void require_words(const Entry& entry, std::size_t count, const std::string& name) {
  if (entry.words.size() == count) return;
  fail(name, entry,
       "expected " + std::to_string(count) + " words, one a field, got " +
           std::to_string(entry.words.size()));
}

void read_fields(const Entries& entries, const std::string& name, PcdHeader& header) {
  const Entry& names = require(entries, "FIELDS", name);
  const Entry& sizes = require(entries, "SIZE", name);
  const Entry& types = require(entries, "TYPE", name);
  const Entry* counts = find_entry(entries, "COUNT");
  for (const Entry* entry : {&sizes, &types, counts}) {
    if (entry != nullptr) require_words(*entry, names.words.size(), name);
  }
  for (std::size_t i = 0; i < names.words.size(); ++i) {
    PcdField field;
    field.name = printable(names.words[i]);
    field.size = whole_number(sizes.words[i], sizes, name);
    if (types.words[i].size() != 1) fail(name, types, "expected I, U or F a field");
    field.type = types.words[i].front();
    const bool real = field.type == 'F' && (field.size == 4 || field.size == 8);
    const bool whole = (field.type == 'I' || field.type == 'U') &&
                       (field.size == 1 || field.size == 2 || field.size == 4 || field.size == 8);
    if (!real && !whole) {
      fail(name, types,
           "field " + field.name + ": no type " + printable(types.words[i]) + " of " +
               std::to_string(field.size) + " bytes");
    }
    if (counts != nullptr) field.count = whole_number(counts->words[i], *counts, name);
    if (field.count == 0 || field.count > kMostColumns ||
        header.columns + field.count > kMostColumns) {
      fail(name, counts != nullptr ? *counts : names,
           "expected 1 to " + std::to_string(kMostColumns) + " numbers a point");
    }
    if (field.name != "_" && header.find(field.name) != nullptr) {
      fail(name, names, "field " + field.name + " for the second time");
    }
    field.offset = header.point_size;
    field.column = header.columns;
    header.point_size += field.size * field.count;
    header.columns += field.count;
    header.fields.push_back(field);
  }
  for (const char* axis : {"x", "y", "z"}) {
    const PcdField* field = header.find(axis);
    if (field == nullptr || field->count != 1) {
      fail(name, names, std::string("expected a field ") + axis + " of one number");
    }
  }
}

void read_size(const Entries& entries, const std::string& name, PcdHeader& header) {
  const Entry& width = require(entries, "WIDTH", name);
  const Entry* height = find_entry(entries, "HEIGHT");
  const Entry* points = find_entry(entries, "POINTS");
  const std::size_t rows = height != nullptr ? single_number(*height, name) : 1;
  const bool overflow = __builtin_mul_overflow(single_number(width, name), rows, &header.points);
  std::size_t bytes = 0;
  if (overflow || __builtin_mul_overflow(header.points, header.point_size, &bytes) ||
      bytes > static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max())) {
    fail(name, width, "WIDTH × HEIGHT is more than any file holds");
  }
  if (points != nullptr && single_number(*points, name) != header.points) {
    fail(name, *points, "POINTS is not WIDTH × HEIGHT = " + std::to_string(header.points));
  }
  if (header.points == 0) fail(name, width, "the cloud holds no point");
}

}  // namespace

const PcdField* PcdHeader::find(std::string_view name) const {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const PcdField& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

PcdHeader read_pcd_header(std::string_view bytes, const std::string& name) {
  PcdHeader header;
  const Entries entries = header_entries(bytes, name, header);
  read_fields(entries, name, header);
  read_size(entries, name, header);
  const Entry& data = require(entries, "DATA", name);
  const std::string kind = data.words.size() == 1 ? data.words.front() : "";
  if (kind == "ascii") {
    header.data = PcdData::kAscii;
  } else if (kind == "binary") {
    header.data = PcdData::kBinary;
  } else if (kind == "binary_compressed") {
    header.data = PcdData::kCompressed;
  } else {
    fail(name, data,
         "expected ascii, binary or binary_compressed, got \"" + printable(kind) + "\"");
  }
  return header;
}

}  // namespace bathyal::soundings
