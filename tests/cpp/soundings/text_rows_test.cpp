// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/text_rows.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bathyal/base/random.hpp"
#include "bathyal/soundings/internal/byte_source.hpp"
#include "bathyal/soundings/internal/field_ends.hpp"
#include "bathyal/soundings/internal/growing_array.hpp"
#include "bathyal/soundings/internal/parse_number.hpp"
#include "bathyal/soundings/internal/text_blocks.hpp"
#include "bathyal/soundings/internal/text_format.hpp"

namespace bathyal {
namespace {

using namespace soundings;

using Offsets = std::vector<std::size_t>;

/// What FieldEnds finds, to the last line end.
template <bool kBlankSeparated>
Offsets ends_of(const std::string& text, char separator) {
  const std::string padded = text + std::string(kFieldBlock, ',');
  FieldEnds<kBlankSeparated> ends(padded.data(), separator);
  Offsets found;
  do {
    found.push_back(static_cast<std::size_t>(ends.next() - padded.data()));
  } while (found.back() + 1 < text.size());
  return found;
}

/// The same by its definition.
Offsets defined_ends(const std::string& text, char separator) {
  const auto is_line_end = [](char c) { return c == '\n' || c == '\r'; };
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  Offsets ends;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char before = i > 0 ? text[i - 1] : '\n';
    const bool first_blank = is_blank(text[i]) && !is_blank(before) && !is_line_end(before);
    const bool parts = separator == ' ' ? first_blank : text[i] == separator;
    if (parts || is_line_end(text[i])) ends.push_back(i);
  }
  return ends;
}

TEST(FieldEnds, FindsWhatItsDefinitionSays) {
  RandomStream random(3);
  const std::string bytes = "11112,,;\t  \r\n\xff";
  for (int i = 0; i < 3000; ++i) {
    std::string text;
    const int length = static_cast<int>(random.uniform(0, 300));
    for (int k = 0; k < length; ++k) {
      text += bytes[static_cast<std::size_t>(random.uniform(0, 1) * 14)];
    }
    text += '\n';
    for (const char separator : {',', ';', '\t'}) {
      ASSERT_EQ(ends_of<false>(text, separator), defined_ends(text, separator)) << text;
    }
    ASSERT_EQ(ends_of<true>(text, ' '), defined_ends(text, ' ')) << text;
  }
}

TextFormat three_columns(char separator) {
  TextFormat format;
  format.separator = separator;
  format.slot = {0, 1, 2};
  format.chosen = 3;
  return format;
}

/// A row of every kind at every offset from the 64 bytes that are looked at together, and behind
/// every other kind.
TEST(TextRows, ReadsEveryKindOfRowAtEveryOffset) {
  for (const char separator : {',', ' ', '\t'}) {
    const std::string s(1, separator);
    const std::vector<std::string> rows = {
        "1.25" + s + "-20" + s + "300.5\n",
        "1.25" + s + "-20" + s + "300.5\r\n",
        "1.25" + s + "-20" + s + "300.5\r",
        "1.25" + s + "-20" + s + "300.5" + s + "\n",
        " 1.25" + s + " -20.0" + s + " +300.5  \n",
        ".125e1" + s + "-20." + s + "0300.50000000000000000\n",
        "\"1.25\"" + s + "-20" + s + "300.5\n",
        "1.25" + s + "-20" + s + "300.5 # far" + s + "off\n",
    };
    TextFormat format = three_columns(separator);
    format.comments = {"#"};
    format.may_comment['#'] = true;
    for (std::size_t shift = 0; shift < 2 * kFieldBlock; ++shift) {
      std::string text(shift, '#');
      if (shift > 0) text.back() = '\n';
      const Index lines = shift > 0 ? 1 : 0;
      for (const std::string& one : rows) {
        for (const std::string& other : rows) text += one + other;
      }
      const auto count = static_cast<Index>(2 * rows.size() * rows.size());
      TextRows parsed;
      const std::string padded = text + std::string(kTextPadding, '\0');
      parse_rows({padded.data(), text.size()}, 0, format, parsed);
      ASSERT_FALSE(parsed.failure) << *parsed.failure << " at shift " << shift;
      ASSERT_EQ(parsed.lines, count + lines);
      ASSERT_EQ(parsed.values.size(), static_cast<std::size_t>(3 * count));
      for (std::size_t i = 0; i < parsed.values.size(); i += 3) {
        ASSERT_EQ(parsed.values.data()[i], 1.25) << shift;
        ASSERT_EQ(parsed.values.data()[i + 1], -20.0) << shift;
        ASSERT_EQ(parsed.values.data()[i + 2], 300.5) << shift;
      }
    }
  }
}

TEST(TextRows, StopsAtTheLineWithTheWrongNumberOfColumns) {
  for (const char* wrong : {"4,5\n", "4,5,6,7\n", "4,5,6,,\n", "4,,6\n", ",\n", "4;5;6\n",
                            "4 5 6\n", "4,5,6 7\n", "4,5,-\n", "4,5,6x\n"}) {
    TextRows rows;
    const std::string text = std::string("1,2,3\n\n1,2,3\n") + wrong + "7,8,9\n";
    const std::string padded = text + std::string(kTextPadding, '\0');
    parse_rows({padded.data(), text.size()}, 0, three_columns(','), rows);
    EXPECT_TRUE(rows.failure) << wrong;
    EXPECT_EQ(rows.lines, 3) << wrong;
    EXPECT_EQ(rows.values.size(), 6U) << wrong;
  }
}

TEST(TextRows, TakesForACommentWhatIsMarkedAsOneEvenADigit) {
  TextFormat format = three_columns(',');
  format.comments = {"-9"};
  format.may_comment['-'] = true;
  TextRows rows;
  const std::string text = "1,2,-3\n-9,0,0\n-8,5,6\n";
  const std::string padded = text + std::string(kTextPadding, '\0');
  parse_rows({padded.data(), text.size()}, 0, format, rows);
  ASSERT_FALSE(rows.failure) << *rows.failure;
  EXPECT_EQ(rows.lines, 3);
  ASSERT_EQ(rows.values.size(), 6U);
  EXPECT_EQ(rows.values.data()[3], -8.0);
}

TEST(TextRows, LooksAtUnwantedTextOnlyAsFarAsAQuoteOrACommentNeeds) {
  TextFormat format;
  format.separator = ' ';
  format.slot = {-1, 0};
  format.chosen = 1;
  TextRows rows;
  const std::string text = "P1 1\n  lost+found\t2\nb\"c 3\nd\fe 4\n";
  const std::string padded = text + std::string(kTextPadding, '\0');
  parse_rows({padded.data(), text.size()}, 0, format, rows);
  ASSERT_TRUE(rows.failure);  // a form feed is a blank: three fields
  EXPECT_EQ(rows.lines, 3);
  ASSERT_EQ(rows.values.size(), 3U);
  EXPECT_EQ(rows.values.data()[2], 3.0);
}

TEST(GrowingArray, KeepsItsValuesWhileItGrowsAndWhenItIsHandedOver) {
  GrowingArray<int> array;
  for (int i = 0; i < 10000; ++i) array.push_back(i);
  ASSERT_EQ(array.size(), 10000U);
  const std::shared_ptr<const int> values = array.release();
  for (int i = 0; i < 10000; ++i) ASSERT_EQ(values.get()[i], i);
  EXPECT_EQ(array.size(), 0U);
}

TEST(TextBlocks, GiveTheWholeTextInWholeLinesForAnyNumberOfThreads) {
  std::string text;
  for (std::int64_t i = 0; text.size() < 2 * TextBlocks::kBlock + 12345; ++i) {
    text += std::to_string(i * 7919) + "\n";
  }
  text += "the last line has no end";
  for (const int num_threads : {1, 3}) {
    const auto source = open_memory(text);
    TextBlocks blocks(*source);
    std::string joined;
    for (blocks.start(TextCut::kLine); !blocks.block().empty();) {
      EXPECT_EQ(blocks.offset(), joined.size());
      EXPECT_EQ(blocks.block().back(), '\n');
      std::vector<std::string> parts(blocks.part_count());
      blocks.parse_parts(
          num_threads, [&](std::size_t i, std::string_view part) { parts[i] = std::string(part); });
      for (const std::string& part : parts) {
        EXPECT_EQ(part.back(), '\n');
        joined += part;
      }
    }
    EXPECT_FALSE(blocks.too_long());
    EXPECT_EQ(joined, text + "\n");
  }
}

TEST(TextFormat, IsDetectedFromTheHead) {
  const TextFormat format =
      detect_format("# made by hand\ndepth;east;north\n1,5;2;3\n2,5;3;4\n", {}, "test");
  EXPECT_EQ(format.separator, ';');
  EXPECT_EQ(format.decimal, ',');
  EXPECT_EQ(format.names, (std::vector<std::string>{"depth", "east", "north"}));
  EXPECT_EQ(format.lines_before, 2);
  EXPECT_EQ(format.chosen, 3);
}

}  // namespace
}  // namespace bathyal
