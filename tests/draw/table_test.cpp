#include "draw/table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/temporary_folder.h"

namespace palpation::draw {
namespace {

class Tables : public testing::Test {
 protected:
  Table table(const std::string& text) { return Table(folder_.file("table.csv", text)); }

  TemporaryFolder folder_;
};

TEST_F(Tables, HaveAColumnForEachName) {
  const Table numbers = table("x,y\n1,10\n2,20\n");
  EXPECT_EQ(numbers.names(), (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(numbers.row_count(), 2);
  EXPECT_EQ(numbers.numbers("y"), (std::vector<double>{10.0, 20.0}));
}

TEST_F(Tables, TakeQuotedCellsWithCommasAndQuotes) {
  EXPECT_EQ(table("name\n\"a, \"\"b\"\"\"\n").texts("name"),
            (std::vector<std::string>{"a, \"b\""}));
}

TEST_F(Tables, SkipEmptyLinesAndCarriageReturns) {
  EXPECT_EQ(table("x\r\n\r\n3\r\n\n").numbers("x"), std::vector<double>{3.0});
}

TEST_F(Tables, HaveNoNumberWhereACellIsEmptyOrAColumnIsMissing) {
  const Table numbers = table("x,y\n1,\n");
  EXPECT_TRUE(std::isnan(numbers.numbers("y").at(0)));
  EXPECT_TRUE(std::isnan(numbers.numbers("z").at(0)));
  EXPECT_FALSE(numbers.has("z"));
}

TEST_F(Tables, AreRefusedWithTheLineAndTheColumn) {
  const auto refusal = [&](const std::string& text) {
    return io_error_of([&] { table(text).numbers("x"); });
  };
  EXPECT_TRUE(contains(refusal("x,y\n1,2\n\n3\n"), "table.csv:4: 1 cell, but"));
  EXPECT_TRUE(contains(refusal("x\n1\ntwo\n"), "table.csv:3: column x: \"two\""));
  EXPECT_TRUE(contains(refusal("\n\n"), "the file is empty"));
}

}  // namespace
}  // namespace palpation::draw
