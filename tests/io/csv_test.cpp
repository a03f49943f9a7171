#include "palpation/io/csv.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "io/temporary_folder.h"

namespace palpation {
namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const CsvTable& table) {
  Rows rows(table.row_count());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t column = 0; column < table.columns().size(); ++column)
      rows[row].emplace_back(table.cell(row, column));
  }
  return rows;
}

std::string error_of(const std::string& text) {
  return io_error_of([&] { parse_csv(text, "t.csv"); });
}

TEST(ParseCsv, KeepsCellsAndTheLinesTheyStandOn) {
  const CsvTable table = parse_csv("a, b\n1,one\n\n2,\n", "t.csv");
  EXPECT_EQ(table.columns(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(rows_of(table), (Rows{{"1", "one"}, {"2", ""}}));
  EXPECT_EQ(table.line(0), 2);
  EXPECT_EQ(table.line(1), 4);
}

TEST(ParseCsv, ReadsTheSameWithAnyLineEndsMarksAndQuotes) {
  const CsvTable plain = parse_csv("a,b\n1,2\n3,\n", "t.csv");
  for (const char* text : {"\xEF\xBB\xBF"
                           "a,b\n1,2\n3,\n",
                           "a,b\r\n1,2\r\n3,\r\n", "a,b\r1,2\r3,\r", "a,b\n1,2\n3,\n  ",
                           "\n a ,\tb\n\n \n1 , 2\n3,\n\n", "\"a\",\"b\"\n\"1\",2\n3,\"\"\n"}) {
    const CsvTable other = parse_csv(text, "t.csv");
    EXPECT_EQ(plain.columns(), other.columns()) << text;
    EXPECT_EQ(rows_of(plain), rows_of(other)) << text;
  }
}

TEST(ParseCsv, RefusesWhatCouldBeMisread) {
  EXPECT_TRUE(contains(error_of(""), "empty"));
  EXPECT_TRUE(contains(error_of("a,b\n1\n"), "t.csv:2: 1 cell, but"));
  EXPECT_TRUE(contains(error_of("a,b\n1,2,3\n"), "t.csv:2: 3 cells"));
  // 806.0 that was cut to 8, or to a cell too few: what is said is that it was cut.
  for (const char* torn : {"a,b\n1,806.0\n2,8", "a,b\n1,806.0\n2", "a,b\r\n1,2\r\n2,\"8"})
    EXPECT_TRUE(contains(error_of(torn), "t.csv:3: the last line has no line end")) << torn;
  EXPECT_TRUE(contains(error_of("a,b"), "t.csv:1: the last line has no line end"));
  EXPECT_TRUE(contains(error_of("a,a\n"), "\"a\" appears twice"));
  EXPECT_TRUE(contains(error_of("a,,b\n"), "no name"));
  EXPECT_TRUE(contains(error_of("a,b,\n1,2,\n"), "t.csv:1: a column has no name: take the comma"));
  EXPECT_TRUE(contains(error_of("a,b\n1,2,\n"), "a comma at the line's end is one too many"));
  EXPECT_TRUE(contains(error_of("# arm 7\na,b\n1,2\n"), "t.csv:1: begins with #"));
  EXPECT_TRUE(contains(error_of("a,b\n1,2\n# a pause\n"), "t.csv:3: begins with #"));
  EXPECT_TRUE(contains(error_of("a\n\"open\n"), "t.csv:2: a quoted cell does not end"));
  EXPECT_TRUE(contains(error_of("a\nx\"y\n"), "a quote inside"));
  EXPECT_TRUE(contains(error_of(std::string("a\n1\0\n", 5)), "byte 3: a NUL"));
  EXPECT_TRUE(contains(error_of("a\n" + std::string(70000, '1')), "t.csv:2: a line of more than"));
  EXPECT_TRUE(contains(error_of(std::string(1024, ',') + "\n"), "t.csv:1: more than 1024 columns"));
  EXPECT_TRUE(contains(error_of("x;y\n1,5;2\n"), "t.csv:1: the header has semicolons"));
  EXPECT_TRUE(contains(error_of("x\ty\n"), "t.csv:1: the header has tabs"));
  EXPECT_TRUE(contains(error_of("0.5,1,2\n"), "t.csv:1: the header line"));
  EXPECT_TRUE(contains(error_of("x,y\n0,5,1,5\n"), "decimals take a point"));
}

TEST(NumberAt, TellsAnEmptyCellFromNanAndFromZero) {
  const CsvTable table = parse_csv("x,y\n,1\nnan,1\n0,1\n-1e-3,1\n+2,1\n", "t.csv");
  EXPECT_FALSE(number_at(table, 0, 0).has_value());
  EXPECT_TRUE(std::isnan(number_at(table, 1, 0).value()));
  EXPECT_EQ(number_at(table, 2, 0), 0.0);
  EXPECT_EQ(number_at(table, 3, 0), -1e-3);
  EXPECT_EQ(number_at(table, 4, 0), 2.0);
  for (const std::size_t row : {0u, 1u}) EXPECT_THROW(finite_number_at(table, row, 0), IoError);
}

TEST(NumberAt, NamesLineColumnAndValueOfACellThatIsNone) {
  const CsvTable table = parse_csv("x,y\n1,2\n1e400,0x10\n1e-400,\"0,5\"\n", "t.csv");
  const auto fault_at = [&](std::size_t row, std::size_t column) {
    return io_error_of([&] { number_at(table, row, column); });
  };
  EXPECT_EQ(fault_at(1, 1), "t.csv:3: column y: \"0x10\" is not a number");
  EXPECT_EQ(fault_at(1, 0), "t.csv:3: column x: \"1e400\" is too large for a double");
  EXPECT_EQ(fault_at(2, 0), "t.csv:4: column x: \"1e-400\" is too small for a double: write 0");
  EXPECT_EQ(fault_at(2, 1), "t.csv:4: column y: \"0,5\" is not a number: decimals take a point");
  EXPECT_EQ(io_error_of([&] { column_index(table, "z"); }),
            "t.csv:1: no column \"z\" among \"x, y\"");
}

TEST(CsvLine, ComesBackAsTheSameCells) {
  const std::array<std::string, 5> cells = {"plain", "with, comma", "with \"quote\"", " blanks ",
                                            ""};
  const CsvTable table = parse_csv("a,b,c,d,e\n" + csv_line(cells), "t.csv");
  EXPECT_EQ(rows_of(table), (Rows{{cells.begin(), cells.end()}}));
}

}  // namespace
}  // namespace palpation
