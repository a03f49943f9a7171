#include "palpation/io/csv.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "io/temporary_folder.h"

namespace palpation {
namespace {

std::string error_of(const std::string& text) {
  return io_error_of([&] { parse_csv(text, "t.csv"); });
}

TEST(ParseCsv, KeepsCellsAndTheLinesTheyStandOn) {
  const CsvTable table = parse_csv("a, b\n1,one\n\n2,\n", "t.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"1", "one"}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"2", ""}));
  EXPECT_EQ(table.lines, (std::vector<int>{2, 4}));
}

TEST(ParseCsv, ReadsTheSameWithAByteOrderMarkAndCarriageReturns) {
  const CsvTable plain = parse_csv("a,b\n1,2\n", "t.csv");
  const CsvTable other = parse_csv(
      "\xEF\xBB\xBF"
      "a,b\r\n1,2\r\n",
      "t.csv");
  EXPECT_EQ(plain.columns, other.columns);
  EXPECT_EQ(plain.rows, other.rows);
}

TEST(ParseCsv, RefusesWhatCouldBeMisread) {
  EXPECT_TRUE(contains(error_of(""), "empty"));
  EXPECT_TRUE(contains(error_of("a,b\n1\n"), "t.csv:2: 1 cells"));
  EXPECT_TRUE(contains(error_of("a,b\n1,2,3\n"), "t.csv:2: 3 cells"));
  EXPECT_TRUE(contains(error_of("a,a\n"), "\"a\" appears twice"));
  EXPECT_TRUE(contains(error_of("a,,b\n"), "no name"));
  EXPECT_TRUE(contains(error_of("a\n\"open\n"), "t.csv:2: a quoted cell does not end"));
  EXPECT_TRUE(contains(error_of("a\nx\"y\n"), "a quote inside"));
  EXPECT_TRUE(contains(error_of(std::string("a\n1\0\n", 5)), "byte 3: a NUL"));
  EXPECT_TRUE(contains(error_of("a\n" + std::string(70000, '1')), "t.csv:2: a line of more than"));
}

TEST(Numbers, TellAnEmptyCellFromNanAndFromZero) {
  const std::vector<std::optional<double>> values = numbers(parse_csv("x,y\n,1\nnan,1\n0,1\n-1e-3,1\n+2,1\n", "t.csv"), "x");
  ASSERT_EQ(values.size(), 5u);
  EXPECT_FALSE(values[0].has_value());
  EXPECT_TRUE(values[1].has_value() && std::isnan(*values[1]));
  EXPECT_EQ(values[2], 0.0);
  EXPECT_EQ(values[3], -1e-3);
  EXPECT_EQ(values[4], 2.0);
}

TEST(Numbers, NameLineColumnAndValueOfACellThatIsNone) {
  const CsvTable table = parse_csv("x,y\n1,2\n1e400,0x10\n", "t.csv");
  EXPECT_EQ(io_error_of([&] { numbers(table, "y"); }), "t.csv:3: column y: \"0x10\" is not a number");
  EXPECT_EQ(io_error_of([&] { numbers(table, "x"); }), "t.csv:3: column x: \"1e400\" is too large for a double");
  EXPECT_TRUE(contains(io_error_of([&] { numbers(table, "z"); }), "no column \"z\" among \"x, y\""));
}

TEST(CsvLine, ComesBackAsTheSameCells) {
  const std::array<std::string, 5> cells = {"plain", "with, comma", "with \"quote\"", " blanks ", ""};
  const CsvTable table = parse_csv("a,b,c,d,e\n" + csv_line(cells), "t.csv");
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0], std::vector<std::string>(cells.begin(), cells.end()));
}

}  // namespace
}  // namespace palpation
