// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/text_table.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bathyal/base/error.hpp"

namespace bathyal {
namespace {

using Numbers = std::vector<double>;

Numbers numbers_of(const Values& values) { return {values.data(), values.data() + values.rows()}; }

Numbers read(const std::string& text, const TextOptions& options = {}) {
  return numbers_of(parse_text_table(text, options).table);
}

std::string message(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

std::string failure(const std::string& text, const TextOptions& options = {}) {
  return message([&] { parse_text_table(text, options, "f.xyz"); });
}

const Numbers kSix = {1, 2, 3, 4, 5, 6};

TEST(TextTable, ReadsEverySeparatorAndLineEnd) {
  for (const char* text : {"1 2 3\n4 5 6\n", "1,2,3\n4,5,6", "1;2;3\n4;5;6\n", "1\t2\t3\n4\t5\t6\n",
                           "1 2 3\r\n4 5 6\r\n", "1 2 3\r4 5 6", "1 2 3\r\r4 5 6\r",
                           "  1   2 \t 3  \n\n \t \n4 5\t6\t\n", "1 , 2,\t3\n 4,5 ,6 \n",
                           "1,2,3,\n4,5,6,\n", "1;2;3;\n4;5;6\n", "\"1\",\"2\",'3'\n4,\"5\",6\n",
                           "\xef\xbb\xbf"
                           "1 2 3\n4 5 6\n",
                           "+1 2.0 3e0\n.4e1 5. 6\n", "1\t2\t3\t\n4\t5\t6\t\n"}) {
    const TextTable table = parse_text_table(text);
    EXPECT_EQ(table.rows, 2) << text;
    EXPECT_EQ(table.width, 3) << text;
    EXPECT_EQ(numbers_of(table.table), kSix) << text;
  }
}

TEST(TextTable, SkipsComments) {
  for (const char* text : {"# a 9 9\n1 2 3\n// b\n4 5 6\n", "% a\n! b\n; c\n1 2 3\n4 5 6\n",
                           "1,2,3 # far\n4,5,6 // x, y\n", "1 2 3 ! note\n  # 7 8 9\n4 5 6\n#"}) {
    EXPECT_EQ(read(text), kSix) << text;
  }
  TextOptions options;
  options.comments = {"REM"};
  EXPECT_EQ(read("REM 7 8 9\n1 2 3\n4 5 6\n", options), kSix);
  EXPECT_EQ(failure("# 1\n1 2 3\n", options),
            "f.xyz:1: expected a number in column 0, got \"#\", in \"# 1\"");
}

TEST(TextTable, TakesNamesFromAHeaderOrAComment) {
  const std::vector<std::string> names = {"x", "y", "z"};
  for (const char* text : {"x y z\n1 2 3\n", "Survey of May\nx,y,z\n1,2,3\n", "# x y z\n1 2 3\n",
                           "//x,y,z\n1,2,3\n", "\"x\";\"y\";\"z\"\n1;2;3\n", "x,y,z,\n1,2,3,\n"}) {
    EXPECT_EQ(parse_text_table(text).names, names) << text;
  }
  EXPECT_TRUE(parse_text_table("# made by 3 people\n1 2 3\n").names.empty());
  EXPECT_TRUE(parse_text_table("one two\n1 2 3\n").names.empty());
  TextOptions options;
  options.header_lines = 1;
  EXPECT_EQ(read("7 8 9\n1 2 3\n4 5 6\n", options), kSix);
  options.header_lines = 0;
  EXPECT_NE(
      failure("x y z\n1 2 3\n", options).find("f.xyz:1: expected a number in column 0, got \"x\""),
      std::string::npos);
  options = {};
  options.skip_lines = 2;
  EXPECT_EQ(read("3\n\"unclosed\n1 2 3\n4 5 6\n", options), kSix);
}

TEST(TextTable, ChoosesColumnsByIndexAndName) {
  const std::string text = "id,X,Y,depth\nP1,10,20,-5\nP2,11,21,-6\n";
  TextOptions options;
  options.columns = {std::string("depth"), Index{1}, std::string("y")};
  EXPECT_EQ(read(text, options), (Numbers{-5, 10, 20, -6, 11, 21}));
  EXPECT_EQ(parse_text_table(text, options).names, (std::vector<std::string>{"depth", "X", "Y"}));
  options.leading = 2;
  const TextTable table = parse_text_table(text, options);
  EXPECT_EQ(numbers_of(table.table), (Numbers{-5, 10, -6, 11}));
  ASSERT_EQ(table.extra.size(), 1U);
  EXPECT_EQ(numbers_of(table.extra[0]), (Numbers{20, 21}));

  options = {};
  options.columns = {Index{2}, Index{1}};
  EXPECT_EQ(read("a b,1,2\nc \"d\",3,4\n\"e, f\",5,6\n", options), (Numbers{2, 1, 4, 3, 6, 5}));
  options.columns = {Index{3}};
  EXPECT_THROW(parse_text_table("1 2 3\n", options), std::invalid_argument);
  options.columns = {std::string("w")};
  EXPECT_THROW(parse_text_table("x y\n1 2\n", options), std::invalid_argument);
  options.columns = {Index{1}, std::string("y")};
  EXPECT_THROW(parse_text_table("x y\n1 2\n", options), std::invalid_argument);
  options = {};
  options.leading = 4;
  EXPECT_THROW(parse_text_table("1 2 3\n", options), std::invalid_argument);
}

TEST(TextTable, TakesADecimalCommaOnlyWhereItIsUnambiguous) {
  EXPECT_EQ(read("1,5;2;-3,25\n"), (Numbers{1.5, 2, -3.25}));
  EXPECT_EQ(parse_text_table("1,5\t2\n").decimal, ',');
  EXPECT_EQ(read("620152,873;7246504,912;-52,913\n"), (Numbers{620152.873, 7246504.912, -52.913}));
  EXPECT_NE(failure("a;b\n1,234;5,678\n").find("f.xyz:2: \"1,234\" may have decimals or thousands"),
            std::string::npos);
  TextOptions options;
  options.decimal = ',';
  EXPECT_EQ(read("1,234;5,678\n", options), (Numbers{1.234, 5.678}));
  EXPECT_EQ(read("1,5 2 3,5\n", options), (Numbers{1.5, 2, 3.5}));
  options.decimal = '.';
  EXPECT_NE(failure("1,5;2\n", options).find("`decimal`"), std::string::npos);
  // Blanks and commas: the comma separates, and what then is no number is an error.
  EXPECT_NE(failure("1,5 2,5\n").find("f.xyz:1: "), std::string::npos);
  EXPECT_NE(failure("1.5;2,5\n").find("got \"2,5\""), std::string::npos);
}

TEST(TextTable, KeepsNanAndInfinityAndRefusesEmptyFields) {
  const Numbers values = read("nan -inf +Infinity\n");
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(values[1], -INFINITY);
  EXPECT_EQ(values[2], INFINITY);
  for (const char* text : {"1,,3\n", ",2,3\n", "1,NA,3\n", "1,\"\",3\n", "1,null,3\n"}) {
    EXPECT_NE(failure(text).find("`empty_is_nan`"), std::string::npos) << failure(text);
    TextOptions options;
    options.empty_is_nan = true;
    EXPECT_EQ(parse_text_table(text, options).width, 3);
  }
  TextOptions options;
  options.empty_is_nan = true;
  const Numbers last = read("1,2,3\n4,5,\n", options);
  EXPECT_EQ(last[4], 5.0);
  EXPECT_TRUE(std::isnan(last[5]));
  EXPECT_NE(failure("1,2,3\n4,5,\n").find("f.xyz:2: "), std::string::npos);
}

TEST(TextTable, NamesLineAndTextOfWhatItCannotRead) {
  EXPECT_EQ(failure("1 2 3\n\n# c\n4 5\n"), "f.xyz:4: expected 3 columns, got 2, in \"4 5\"");
  EXPECT_EQ(failure("1 2 3\r\n4 5 6 7\r\n"), "f.xyz:2: expected 3 columns, got 4, in \"4 5 6 7\"");
  EXPECT_EQ(failure("x y z\n1 2 3\n4 5 abc\x01\n"), "f.xyz: not text: byte \\x01 at offset 19");
  EXPECT_EQ(failure("x y z\n1 2 3\n4 5 \xff\n"),
            "f.xyz:3: expected a number in column 2 (z), got \"\\xff\", in \"4 5 \\xff\"");
  EXPECT_EQ(failure("1,2\n\"3,4\n"),
            "f.xyz:2: a quote that does not end with its field, in \"\"3,4\"");
  EXPECT_NE(failure("1,2\n\"3\"4,5\n").find("f.xyz:2: a quote"), std::string::npos);
  EXPECT_NE(failure("1 2\n0x10 1\n").find("f.xyz:2: "), std::string::npos);
  EXPECT_NE(failure("1 2\n1_0 1\n").find("f.xyz:2: "), std::string::npos);
  EXPECT_EQ(failure(""), "f.xyz: the file is empty");
  EXPECT_EQ(failure("\n \n# only\n"), "f.xyz: no row of numbers in 3 lines");
  EXPECT_EQ(failure("a b\nc d\n"),
            "f.xyz: no row of numbers in 2 lines, of which 2 look like a header");
  EXPECT_EQ(failure(std::string("\xff\xfe"
                                "1\0 \0",
                                6)),
            "f.xyz: UTF-16 text; save it as UTF-8");
  EXPECT_EQ(failure(std::string("\x89PNG\r\n\x1a\n\0\0", 10)),
            "f.xyz: not text: byte \\x1a at offset 6");
}

TEST(TextTable, RefusesOptionsThatMakeNoSense) {
  const auto refused = [](const std::function<void(TextOptions&)>& set) {
    TextOptions options;
    set(options);
    EXPECT_THROW(parse_text_table("1 2 3\n", options), std::invalid_argument);
  };
  refused([](TextOptions& o) { o.separator = 'x'; });
  refused([](TextOptions& o) { o.decimal = ';'; });
  refused([](TextOptions& o) { o.separator = o.decimal = ','; });
  refused([](TextOptions& o) { o.comments = {""}; });
  refused([](TextOptions& o) { o.header_lines = -2; });
  refused([](TextOptions& o) { o.skip_lines = -1; });
  refused([](TextOptions& o) { o.leading = -1; });
  refused([](TextOptions& o) { o.columns = {Index{-1}}; });
  refused([](TextOptions& o) { o.num_threads = -1; });
}

/// A text of several blocks whose rows know their own number.
std::string long_text(int rows, const std::string& end) {
  std::string text = "row x" + end;
  for (int i = 0; i < rows; ++i) {
    if (i % 1000 == 7) text += "# comment" + end;
    if (i % 1000 == 13) text += end;
    text += std::to_string(i) + " " + std::to_string(i) + ".25" + end;
  }
  return text;
}

TEST(TextTable, IsTheSameForAnyNumberOfThreadsAndAcrossBlocks) {
  constexpr int kRows = 700000;  // some 12 MB: six blocks
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const std::string text = long_text(kRows, end);
    for (const int threads : {1, 3, 8}) {
      TextOptions options;
      options.num_threads = threads;
      const TextTable table = parse_text_table(text, options);
      ASSERT_EQ(table.rows, kRows);
      for (Index i = 0; i < kRows; ++i) {
        ASSERT_EQ(table.table.data()[2 * i], static_cast<double>(i));
        ASSERT_EQ(table.table.data()[2 * i + 1], static_cast<double>(i) + 0.25);
      }
    }
  }
}

TEST(TextTable, CountsLinesExactlyAcrossBlocksAndThreads) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text = long_text(600000, end);
    const Index lines = 1 + 600000 + 2 * 600;
    text += std::string("oops 1") + end + long_text(100000, end) + "worse" + end;
    for (const int threads : {1, 8}) {
      TextOptions options;
      options.num_threads = threads;
      EXPECT_EQ(failure(text, options), "f.xyz:" + std::to_string(lines + 1) +
                                            ": expected a number in column 0 (row), got \"oops\", "
                                            "in \"oops 1\"");
    }
  }
}

TEST(TextTable, FindsBinaryBytesFarBehindTheHead) {
  std::string text = long_text(600000, "\n");
  const std::size_t offset = text.size();
  text += std::string("\0\0\0", 3) + "\n1 2\n";
  EXPECT_EQ(failure(text),
            "f.xyz:601202: not text: byte \\x00 at offset " + std::to_string(offset));
}

TEST(TextTable, BoundsTheLengthOfALine) {
  const std::string blanks(std::size_t{1} << 21U, ' ');
  EXPECT_EQ(failure("1 2\n3 " + blanks + "4\n"), "f.xyz:2: a line of more than 1 MiB");
  EXPECT_EQ(failure("1 2\n# " + blanks + "\n"), "f.xyz:2: a line of more than 1 MiB");
  EXPECT_NE(failure(std::string(std::size_t{6} << 20U, '1')).find("f.xyz:1: "), std::string::npos);
  EXPECT_EQ(failure("1 2\n" + std::string(std::size_t{9} << 20U, '1')),
            "f.xyz:2: a line of more than 1 MiB");
  EXPECT_EQ(read("1 " + blanks.substr(0, 1 << 19) + "2\n"), (Numbers{1, 2}));
}

TEST(TextTable, ReportsWhyAFileCannotBeOpened) {
  EXPECT_EQ(message([] { read_text_table("no such file.xyz"); }),
            "no such file.xyz: No such file or directory");
  EXPECT_EQ(message([] { read_text_table("/"); }), "/: Is a directory");
}

TEST(TextTable, ReadsAFileAsItReadsMemory) {
  const std::string path =
      testing::TempDir() + "bathyal_text_table_" + std::to_string(getpid()) + ".xyz";
  std::ofstream(path, std::ios::binary) << long_text(1000, "\r\n");
  const TextTable table = read_text_table(path);
  EXPECT_EQ(numbers_of(table.table), read(long_text(1000, "\n")));
  std::remove(path.c_str());
}

TEST(AsciiGrid, GivesCellCentresFromTheNorthAndDropsWhatHasNoValue) {
  const std::string text =
      "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -1\n"
      "1 2 -1\n-1.0 nan\n6\n";
  const TextTable table = parse_text_table(text);
  EXPECT_TRUE(table.grid);
  EXPECT_EQ(table.names, (std::vector<std::string>{"x", "y", "z"}));
  EXPECT_EQ(numbers_of(table.table), (Numbers{105, 215, 1, 115, 215, 2, 125, 205, 6}));
  EXPECT_EQ(read("NCOLS 1\r\nNROWS 1\r\nXLLCENTER 5\r\nYLLCENTER 6\r\nDX 1\r\nDY 2\r\n7"),
            (Numbers{5, 6, 7}));
}

TEST(AsciiGrid, ReadsRowsLongerThanALineMayBe) {
  constexpr int kColumns = 700000;
  std::string text = "ncols 700000\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 1\n";
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i < kColumns; ++i) text += std::to_string(i + row) + ".5 ";
    text += "\n";
  }
  for (const int threads : {1, 8}) {
    TextOptions options;
    options.num_threads = threads;
    const TextTable table = parse_text_table(text, options);
    ASSERT_EQ(table.rows, 2 * kColumns);
    for (Index i = 0; i < table.rows; ++i) {
      const double* p = table.table.data() + 3 * i;
      ASSERT_EQ(p[0], static_cast<double>(i % kColumns));
      ASSERT_EQ(p[1], i < kColumns ? 1.0 : 0.0);
      ASSERT_EQ(p[2], p[0] + 1.5 - p[1]);
    }
  }
}

TEST(AsciiGrid, RefusesHeadersAndDataThatDisagree) {
  const std::string rest = "xllcorner 0\nyllcorner 0\ncellsize 1\n";
  EXPECT_EQ(failure("ncols 2\nnrows 2\n" + rest + "1 2 3\n"), "f.xyz: 3 numbers for 2 × 2 cells");
  EXPECT_EQ(failure("ncols 2\nnrows 1\n" + rest + "1 2\n3\n"),
            "f.xyz:7: more numbers than the 2 × 1 cells");
  EXPECT_EQ(failure("ncols 2\nnrows 1\n" + rest + "1\noops\n"),
            "f.xyz:7: expected a number, got \"oops\"");
  EXPECT_EQ(failure("ncols 2\nnrows 1\nyllcorner 0\ncellsize 1\n1 2\n"),
            "f.xyz: the grid's header lacks xllcorner");
  EXPECT_NE(failure("ncols -2\nnrows 1\n" + rest).find("ncols is -2"), std::string::npos);
  EXPECT_NE(failure("ncols 1.5\nnrows 1\n" + rest).find("ncols is 1.5"), std::string::npos);
  EXPECT_NE(failure("ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 0\n1 2").find("cellsize"),
            std::string::npos);
  EXPECT_EQ(failure("ncols 1\nnrows 1\n" + rest + "-9999\n"),
            "f.xyz: no cell of the grid has a value");
  // 4.6·10¹⁸ cells: only what is there costs memory.
  EXPECT_NE(failure("ncols 2147483647\nnrows 2147483647\n" + rest + "1 2\n").find("2 numbers for"),
            std::string::npos);
}

}  // namespace
}  // namespace bathyal
