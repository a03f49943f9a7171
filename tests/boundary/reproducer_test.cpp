// No input is known that makes an overlay fail, so what its error would carry is tested by itself.
#include "boundary/reproducer.h"

#include <gtest/gtest.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "boundary/polygons.h"

namespace palpation {
namespace {

using testing::box;

/// The numbers of a text, and what is left of it without them.
struct Read {
  std::vector<double> numbers;
  std::string rest;
};

Read read(const std::string& text) {
  Read read;
  for (const char* at = text.data(); at < text.data() + text.size();) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(at, text.data() + text.size(), number);
    if (error == std::errc() && end > at) {
      read.numbers.push_back(number);
      at = end;
    } else {
      read.rest += *at++;
    }
  }
  return read;
}

TEST(Reproducer, IsWellKnownTextOfPolygonsWithHolesAndOfRings) {
  const std::vector<PolygonWithHoles> polygons{
      {box(0, 0, 3, 3), {box(1, 1, 2, 2)}}, {{}, {}}, {{{5, 5}, {6, 5}, {5, 6.5}}, {{}}}};
  EXPECT_EQ(well_known_text(polygons),
            "MULTIPOLYGON (((0 0, 3 0, 3 3, 0 3, 0 0), (1 1, 2 1, 2 2, 1 2, 1 1)), ((5 5, 6 5, 5 "
            "6.5, 5 5)))");
  EXPECT_EQ(well_known_text(std::vector<Ring>{box(0, 0, 1, 1), {}, {{2, 2}}}),
            "MULTILINESTRING ((0 0, 1 0, 1 1, 0 1, 0 0), (2 2, 2 2))");
  EXPECT_EQ(well_known_text(std::vector<PolygonWithHoles>{}), "MULTIPOLYGON EMPTY");
  EXPECT_EQ(well_known_text(std::vector<Ring>{}), "MULTILINESTRING EMPTY");
}

TEST(Reproducer, KeepsAllDigitsOfADouble) {
  const Ring awkward{{1.0 / 3.0, -1e-17},
                     {std::nextafter(1.0, 2.0), std::ldexp(1.0, -1074)},
                     {123456789.123456789, 0.1 + 0.2}};
  const std::vector<double> numbers = read(well_known_text(std::vector<Ring>{awkward})).numbers;
  ASSERT_EQ(numbers.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_EQ(numbers[i], awkward[i / 2 % 3][static_cast<Eigen::Index>(i % 2)]);
}

TEST(Reproducer, OfHugeOperandsStaysShortAndWhole) {
  Random random(1);
  std::vector<Ring> rings(3000, box(0.1, 0.2, 0.3, 0.4));
  rings.push_back(testing::star(random, {0, 0}, 1.0, 200'000));
  const std::string text = well_known_text(rings);
  EXPECT_LT(text.size(), 21'000u);
  const std::size_t end = text.rfind(')');
  EXPECT_EQ(text.substr(end - 1, 2), "))");
  const std::size_t kept = read(text.substr(0, end)).numbers.size() / 10;
  EXPECT_GT(kept, 400u);
  EXPECT_EQ(text.substr(end + 1), " and " + std::to_string(3001 - kept) + " more of " +
                                      std::to_string(4 * (3000 - kept) + 200'000) + " corners");
  EXPECT_EQ(well_known_text(std::vector<Ring>{testing::star(random, {0, 0}, 1.0, 200'000)}),
            "MULTILINESTRING EMPTY and 1 more of 200000 corners");
}

}  // namespace
}  // namespace palpation
